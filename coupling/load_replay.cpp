#include "coupling/load_replay.hpp"

#include <algorithm>
#include <limits>

#include "coupling/host_rigid_body.hpp"

namespace nilas {
inline namespace NILAS_BULLET {

namespace {

/// There is no ice to meet a surface: any shape will do, with as few boundary particles as it takes.
Body unseen_body_of(const btRigidBody& bullet) { return body_of(bullet, rigid::Sphere{1}, 1, Vec3::Zero(), "body"); }

constexpr double kAnyPush = std::numeric_limits<double>::infinity();  // there is no ice to be pushed into

}  // namespace

LoadReplay::LoadReplay(SameBullet, LoadRecord record, btRigidBody& body)
    : record_(std::move(record)),
      body_(unseen_body_of(body)),
      host_(std::make_unique<HostRigidBody>(body, kAnyPush)),
      time_(record_.rows().front().time) {}

void LoadReplay::updateAction(btCollisionWorld* world, btScalar dt) {
  if (!host_->in(world)) return;
  const ExternalLoad load = host_->take_over(body_, dt, 0).load;
  const double end = time_ + dt;
  while (time_ < end) advance_to(next_ < record_.rows().size() ? std::min(record_.rows()[next_].time, end) : end, load);
  host_->hand_back(body_);
}

/// One sub-step, as Impact's: within a row of the record.
void LoadReplay::advance_to(double time, const ExternalLoad& load) {
  const std::vector<LoadRow>& rows = record_.rows();
  sph::Surface surface;
  if (next_ < rows.size()) {
    const LoadRow &before = rows[next_ - 1], &after = rows[next_];
    surface.force = (after.impulse - before.impulse) / (after.time - before.time);
    surface.moment = (after.angular_impulse - before.angular_impulse) / (after.time - before.time);
    if (time == after.time) ++next_;
  }
  const double dt = time - time_;
  body_.drift(dt / 2);
  body_.kick(surface, load, dt);
  body_.drift(dt / 2);
  time_ = time;
}

}  // namespace NILAS_BULLET
}  // namespace nilas
