// Compiled once per precision of Bullet.
#include "coupling/bullet_check.hpp"

#include <gtest/gtest.h>

#include <string>

namespace nilas {
namespace {

constexpr bool kDouble = sizeof(btScalar) == sizeof(double);
constexpr std::size_t kOtherScalar = kDouble ? sizeof(float) : sizeof(double);
const std::string kLibrary = kDouble ? "nilas::coupling" : "nilas::coupling-f32";
const std::string kOtherLibrary = kDouble ? "nilas::coupling-f32" : "nilas::coupling";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(BulletCheck, AcceptsTheBulletThatTheLibraryWasBuiltWith) {
  EXPECT_EQ(nilas_bullet_mismatch(sizeof(btScalar), sizeof(btRigidBody), BT_BULLET_VERSION), nullptr);
  EXPECT_NO_THROW(SameBullet());
}

TEST(BulletCheck, NamesBothPrecisionsAndTheLibraryToLink) {
  const char* why = nilas_bullet_mismatch(kOtherScalar, 1000, BT_BULLET_VERSION);
  ASSERT_NE(why, nullptr);
  EXPECT_TRUE(contains(why, "single precision") && contains(why, "double precision")) << why;
  EXPECT_TRUE(contains(why, ": link " + kOtherLibrary)) << why;
  EXPECT_TRUE(contains(why, "1000 bytes") && contains(why, std::to_string(sizeof(btRigidBody)))) << why;
}

TEST(BulletCheck, NamesBothVersions) {
  const char* why = nilas_bullet_mismatch(sizeof(btScalar), sizeof(btRigidBody), 289);
  ASSERT_NE(why, nullptr);
  EXPECT_TRUE(contains(why, "Bullet 2.89") && contains(why, "Bullet 3.")) << why;
  EXPECT_TRUE(contains(why, "build both with the same Bullet and link " + kLibrary)) << why;
}

TEST(BulletCheck, FindsAnotherLayoutOfTheSameVersion) {
  EXPECT_NE(nilas_bullet_mismatch(sizeof(btScalar), sizeof(btRigidBody) + 8, BT_BULLET_VERSION), nullptr);
}

TEST(BulletCheck, FitsWhateverTheCallerSays) {
  const std::string why = nilas_bullet_mismatch(1, ~std::size_t{0}, -2147483647 - 1);
  EXPECT_TRUE(contains(why, "link nilas::")) << why;
}

}  // namespace
}  // namespace nilas
