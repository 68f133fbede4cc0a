/// The same request gives the same bits, whatever runs beside it.
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "api/api.h"
#include "tests/paths/reference_problems.h"

namespace snapthrough {
namespace {

using namespace testing;

std::string answer_to(const ReferenceProblem& problem) {
  api::Request request;
  request.model = problem.model;
  request.analysis = problem.analysis;
  return api::write_result(request, solve(problem.model, problem.analysis), 0.0).dump();
}

/// Answers to all problems; the problem with index `first` is solved first.
std::vector<std::string> answers_from(std::size_t first, const std::vector<ReferenceProblem>& problems) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < problems.size(); ++i)
    out.push_back(answer_to(problems[(i + first) % problems.size()]));
  return out;
}

TEST(Determinism, SameRequestSameBitsWhateverRunsBeside) {
  const std::vector<ReferenceProblem> problems{shallow_arch(1e7, Side::left, {}), deep_arch(215.0, 1e4, 0.0),
                                               ring_in_medium(1200.0, {}, 0.0), lee_frame_path({}),
                                               imperfect_column(1e-8)};
  std::vector<std::string> alone;
  for (const ReferenceProblem& problem : problems) alone.push_back(answer_to(problem));
  for (const int workers : {2, 5}) {
    std::vector<std::vector<std::string>> answers(static_cast<std::size_t>(workers));
    {
      std::vector<std::jthread> threads;
      for (std::size_t w = 0; w < answers.size(); ++w)
        threads.emplace_back([&problems, &out = answers[w], w] { out = answers_from(w, problems); });
    }
    for (std::size_t w = 0; w < answers.size(); ++w)
      for (std::size_t i = 0; i < problems.size(); ++i)
        EXPECT_EQ(answers[w][i], alone[(i + w) % problems.size()])
            << problems[(i + w) % problems.size()].name;
  }
}

}  // namespace
}  // namespace snapthrough
