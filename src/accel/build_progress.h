/// Reports how far a build is, from one thread only.
#pragma once
#include <atomic>
#include <cstddef>
#include <functional>
#include <thread>

namespace importon {

/// add() may be called from any thread; `report` is called only from the thread that made this object, at most
/// about a hundred times, with a fraction that never decreases.
class BuildProgress {
 public:
  BuildProgress(std::function<void(double)> report, std::size_t total)
      : report_(std::move(report)), total_(total), owner_(std::this_thread::get_id()) {}

  void add(std::size_t amount) {
    if (!report_) return;
    const std::size_t done = done_.fetch_add(amount, std::memory_order_relaxed) + amount;
    if (std::this_thread::get_id() != owner_) return;
    const double fraction = total_ == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(total_);
    if (fraction < lastReported_ + kStep) return;
    lastReported_ = fraction;
    report_(fraction < 1.0 ? fraction : 1.0);
  }
  void finish() {
    if (report_) report_(1.0);
  }

 private:
  static constexpr double kStep = 0.01;
  std::function<void(double)> report_;
  std::size_t total_;
  std::thread::id owner_;
  std::atomic<std::size_t> done_{0};
  double lastReported_ = 0;
};

}  // namespace importon
