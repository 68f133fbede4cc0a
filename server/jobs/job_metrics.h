#pragma once
/// @file
/// Metrics of jobs and of points of sweeps.

#include <string>
#include <string_view>

#include "server/metrics/metrics.h"

namespace snapthrough::server {

/// Outcomes and durations of jobs and points in this process. Thread-safe.
struct JobMetrics {
  Counter jobs{"snapthrough_jobs_ended_total", "Jobs that ended: successful, dismissed, or why they failed."};
  Counter points{"snapthrough_sweep_points_ended_total",
                 "Points of sweeps that got their row: successful, reused, or why they failed."};
  Histogram waiting{"snapthrough_job_waiting_seconds", "From a job's submission to its first attempt."};
  Histogram running{"snapthrough_job_running_seconds", "Of an attempt, to the end of the job."};

  void job_ended(std::string_view code) { jobs.add(label("code", code)); }
  void point_ended(std::string_view code) { points.add(label("code", code)); }
  void write(std::string& text) const {
    jobs.write(text);
    points.write(text);
    waiting.write(text);
    running.write(text);
  }
};

}  // namespace snapthrough::server
