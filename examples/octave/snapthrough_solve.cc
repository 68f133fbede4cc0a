// snapthrough for GNU Octave: result = jsondecode(snapthrough_solve(request))
//
//   mkoctfile snapthrough_solve.cc $(pkg-config --cflags --libs snapthrough)
//   octave --eval 'r = jsondecode(snapthrough_solve(fileread("../buried_pipe.json"))); r.summary.critical_load_factor'
//
// A request with mistakes, or an analysis that fails, is an error of Octave with the problem document as its message.
#include <octave/oct.h>
#include <snapthrough/snapthrough.h>

#include <string>

DEFUN_DLD(snapthrough_solve, args, , "result = snapthrough_solve (request): JSON text of the result of a JSON text") {
  if (args.length() != 1 || !args(0).is_string()) {
    error("snapthrough_solve: the request is one text");
  }
  const std::string request = args(0).string_value();
  const auto stop_on_interrupt = [](const snapthrough_progress*, void*) {
    return static_cast<int>(octave_interrupt_state > 0);
  };
  snapthrough_document* document =
      snapthrough_solve(request.data(), request.size(), nullptr, stop_on_interrupt, nullptr);
  if (document == nullptr) {
    error("snapthrough_solve: out of memory");
  }
  const std::string text(document->text, document->length);
  const snapthrough_status status = document->status;
  snapthrough_free(document);
  if (status != SNAPTHROUGH_DONE) {
    error("snapthrough_solve: %s", text.c_str());
  }
  return octave_value(text);
}
