#pragma once
/// @file
/// Limit of the work that a caller waits for on its thread.

#include <functional>
#include <optional>

namespace snapthrough {

/// Why work ends before it is done.
enum class WorkEnd {
  time_used,  ///< the work takes longer than it may
  abandoned,  ///< nobody waits for the work any more
  stopping    ///< the program is about to end
};

/// Thrown by WorkLimit::poll() where the limit is reached. Not an std::exception, so that nothing takes it
/// for a failure of its own.
struct WorkEnded {
  WorkEnd cause = WorkEnd::time_used;
};

/// @brief While it lives, loops of this thread whose length a document sets end when it is over.
///
/// They call poll(). Reading and checking of a model poll at each thing of a list and along each curve.
/// Limits nest: the innermost one holds.
class WorkLimit {
 public:
  /// @param is_over returns why the work is to end, nullopt while it may go on; called at some polls. It must
  /// not throw.
  explicit WorkLimit(std::function<std::optional<WorkEnd>()> is_over);
  ~WorkLimit();
  WorkLimit(const WorkLimit&) = delete;
  WorkLimit& operator=(const WorkLimit&) = delete;
  WorkLimit(WorkLimit&&) = delete;
  WorkLimit& operator=(WorkLimit&&) = delete;

  /// Throws WorkEnded when the innermost limit that lives on this thread is over; does nothing on a thread
  /// without a limit.
  static void poll();

 private:
  std::function<std::optional<WorkEnd>()> is_over_;
  WorkLimit* outer_;
  unsigned polls_ = 0;
};

}  // namespace snapthrough
