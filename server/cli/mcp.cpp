#include <csignal>
#include <utility>

#include "server/cli/commands.h"
#include "server/cli/plot_file.h"
#include "server/mcp/session.h"
#include "server/worker/isolated_runner.h"

namespace snapthrough::server::cli {

int mcp_command(std::int64_t memory, const Streams& streams) {
  std::signal(SIGPIPE, SIG_IGN);  // a client that has gone ends the session by the end of its stream
  RunnerCounters counters;
  IsolatedRunnerOptions options;
  options.memory = memory;
  mcp::serve_session(streams.in, streams.out, {isolated_runners(std::move(options), counters), png_of});
  return kDone;
}

}  // namespace snapthrough::server::cli
