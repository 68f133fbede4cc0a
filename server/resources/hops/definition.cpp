#include "server/resources/hops/definition.h"

#include <utility>

namespace snapthrough::server::hops {
namespace {

using api::ComponentInput;
using api::ComponentOutput;
using api::ComponentValue;
using api::PlugType;
using nlohmann::json;

class SweepDefinition final : public Definition {
 public:
  explicit SweepDefinition(api::Component component) : component_(std::move(component)) {}

  [[nodiscard]] std::string description() const override { return component_.title(); }
  [[nodiscard]] const std::vector<ComponentInput>& inputs() const override { return component_.inputs(); }
  [[nodiscard]] const std::vector<ComponentOutput>& outputs() const override { return component_.outputs(); }
  [[nodiscard]] Call call(const std::map<std::string, json>& values) const override {
    api::ComponentCall call = component_.call(values);
    return {std::move(call.findings), call.document.is_null() ? "" : call.document.dump()};
  }
  [[nodiscard]] std::string input_at(std::string_view pointer) const override {
    return component_.input_at(pointer);
  }
  [[nodiscard]] std::vector<std::string> parts() const override { return component_.parts(); }
  [[nodiscard]] std::vector<ComponentValue> values(const json& result) const override {
    return component_.values(result);
  }

 private:
  const api::Component component_;
};

constexpr const char* kRequest = "request";

class RequestDefinition final : public Definition {
 public:
  explicit RequestDefinition(std::string_view example)
      : inputs_{{kRequest,
                 "Request document (JSON), as POST /v1/jobs takes it",
                 PlugType::text,
                 false,
                 std::string(example),
                 {},
                 {},
                 {}}},
        outputs_{{"critical_load_factor", "/summary/critical_load_factor of the result", PlugType::number},
                 {"critical_type", "/summary/critical_type of the result", PlugType::text},
                 {"message", "/summary/message of the result", PlugType::text},
                 {"result", "The result document (JSON)", PlugType::text}} {}

  [[nodiscard]] std::string description() const override {
    return "Any analysis: takes a request document and gives its result";
  }
  [[nodiscard]] const std::vector<ComponentInput>& inputs() const override { return inputs_; }
  [[nodiscard]] const std::vector<ComponentOutput>& outputs() const override { return outputs_; }
  [[nodiscard]] Call call(const std::map<std::string, json>& values) const override {
    const auto found = values.find(kRequest);
    if (found == values.end()) {
      return {{{"/" + std::string(kRequest), "missing_field", "has no value"}}, ""};
    }
    std::string text = found->second.get<std::string>();
    if (text.empty()) {
      return {{{"/" + std::string(kRequest), "malformed", "is empty: expected a request document"}}, ""};
    }
    return {{}, std::move(text)};
  }
  [[nodiscard]] std::string input_at(std::string_view /*pointer*/) const override { return kRequest; }
  [[nodiscard]] std::vector<std::string> parts() const override { return {}; }
  [[nodiscard]] std::vector<ComponentValue> values(const json& result) const override {
    const json& summary = result.at("summary");
    return {{summary.at("critical_load_factor"), {}},
            {summary.at("critical_type"), {}},
            {summary.at("message"), {}},
            {result.dump(), {}}};
  }

 private:
  const std::vector<ComponentInput> inputs_;
  const std::vector<ComponentOutput> outputs_;
};

}  // namespace

std::shared_ptr<const Definition> sweep_definition(api::Component component) {
  return std::make_shared<SweepDefinition>(std::move(component));
}

std::shared_ptr<const Definition> request_definition(std::string_view example) {
  return std::make_shared<RequestDefinition>(example);
}

}  // namespace snapthrough::server::hops
