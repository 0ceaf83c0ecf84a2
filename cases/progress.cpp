#include "cases/progress.hpp"

#include <fmt/format.h>

#include <string>

namespace nilas::cases {

Progress::Progress(std::ostream& out, bool terminal, double end_time)
    : out_(out), terminal_(terminal), end_time_(end_time) {}

double Progress::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

void Progress::update(const Impact& impact) {
  const Clock::time_point now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_).count();
  if (since < (terminal_ ? 0.2 : 5.0)) return;
  last_ = now;
  const StepRecord& step = impact.last_step();
  const double done = step.time / end_time_;
  const double elapsed = seconds();
  const double rate = static_cast<double>(step.number) * static_cast<double>(impact.ice().particles().size()) / elapsed;
  const std::string text =
      fmt::format("{:.3f} of {:.3f} ms, dt {:.3g} us ({}), {:.2f} M particle-steps/s, {:.0f} s left", step.time * 1e3,
                  end_time_ * 1e3, step.dt * 1e6, sph::name(step.limiter), rate / 1e6, elapsed / done * (1 - done));
  if (terminal_) {
    constexpr int kWidth = 24;
    const int filled = static_cast<int>(done * kWidth);
    out_ << "\r[" << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] " << text << "\x1b[K";
  } else {
    out_ << text << "\n";
  }
  out_.flush();
}

void Progress::finish() {
  if (terminal_) out_ << "\n";
  out_.flush();
}

}  // namespace nilas::cases
