#include "server/mcp/session.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <istream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <ostream>
#include <streambuf>
#include <thread>

#include "api/json_text.h"

namespace snapthrough::server::mcp {
namespace {

using nlohmann::json;

/// Versions of the protocol, the latest first; a client that asks for another one gets the latest.
constexpr std::array<std::string_view, 4> kVersions{"2025-11-25", "2025-06-18", "2025-03-26", "2024-11-05"};
constexpr std::size_t kLongestMessage = std::size_t{64} << 20;  ///< bytes

// Codes of JSON-RPC 2.0
constexpr int kParseError = -32700;
constexpr int kInvalidRequest = -32600;
constexpr int kNoMethod = -32601;
constexpr int kInvalidParameters = -32602;
constexpr int kInternalError = -32603;

constexpr const char* kInstructions =
    "snapthrough computes equilibrium paths and critical loads of plane slender structures that buckle "
    "against soil or "
    "rock: beams, columns, piles, arches, rings, frames. Units are the user's own, but consistent. Use check "
    "before solve "
    "for a new model. Ask the user for values that are not known; never assume them. Report error_estimate "
    "and confirmed "
    "with each critical load, and warnings as they are.";

/// Reads a line. Returns false at the end of the stream. A line that is too long becomes empty, and `fits`
/// false.
bool read_line(std::istream& in, std::string& line, bool& fits) {
  line.clear();
  fits = true;
  std::streambuf& buffer = *in.rdbuf();
  for (int c = buffer.sbumpc(); c != std::char_traits<char>::eof(); c = buffer.sbumpc()) {
    if (c == '\n') {
      return true;
    }
    if (line.size() == kLongestMessage) {
      line.clear();
      fits = false;
    }
    if (fits) {
      line += static_cast<char>(c);
    }
  }
  return !line.empty();
}

class Session {
 public:
  Session(std::istream& in, std::ostream& out, Surroundings around)
      : in_(in), out_(out), worker_([this, around = std::move(around)] { work(around); }) {}
  ~Session() = default;
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  Session(Session&&) = delete;
  Session& operator=(Session&&) = delete;

  void run() {
    std::string line;
    bool fits = true;
    while (read_line(in_, line, fits)) {
      const api::ParsedText parsed = fits ? api::parse_json(line) : api::ParsedText{};
      if (parsed.document != nullptr) {
        take(*parsed.document);
      } else if (!fits || !line.empty()) {
        send_error(nullptr, kParseError,
                   fits ? parsed.findings.front().detail : "the message is longer than 64 MiB");
      }
    }
    end();
  }

 private:
  /// A call of a tool that waits or is worked on.
  struct Call {
    json id;
    std::string tool;
    json arguments;
    json token;  ///< token of progress; null: none is wanted
    std::stop_source stop = {};
  };

  /// What a running tool says goes to the client.
  class Voice final : public Dialogue {
   public:
    Voice(Session& session, const Call& call) : session_(session), call_(call) {}
    [[nodiscard]] std::stop_token stop() const override { return call_.stop.get_token(); }
    void tell(double done, std::optional<double> total, const std::string& message) override {
      if (call_.token.is_null()) {
        return;
      }
      json news = {{"progressToken", call_.token}, {"progress", done}, {"message", message}};
      if (total) {
        news["total"] = *total;
      }
      session_.send({{"jsonrpc", "2.0"}, {"method", "notifications/progress"}, {"params", std::move(news)}});
    }
    Answer ask(const std::string& message, const json& schema) override {
      return session_.ask(message, schema, call_.stop.get_token());
    }

   private:
    Session& session_;
    const Call& call_;
  };

  void take(const json& message) {
    if (!message.is_object() || message.value("jsonrpc", json()) != "2.0") {
      return send_error(nullptr, kInvalidRequest, "a message is an object of JSON-RPC 2.0");
    }
    const json id = message.value("id", json());
    if (!message.contains("method")) {
      return take_answer(id, message);
    }
    const json params = message.value("params", json::object());
    if (!message.at("method").is_string() || !params.is_object()) {
      return send_error(id, kInvalidRequest, "method is a text, and params an object");
    }
    const auto method = message.at("method").get<std::string>();
    if (id.is_null()) {
      return method == "notifications/cancelled" ? cancel(params.value("requestId", json())) : void();
    }
    take_request(id, method, params);
  }

  void take_request(const json& id, const std::string& method, const json& params) {
    if (method == "initialize") {
      return send_result(id, greet(params));
    }
    if (method == "ping") {
      return send_result(id, json::object());
    }
    if (method == "tools/list") {
      return send_result(id, {{"tools", tool_list()}});
    }
    if (method == "tools/call") {
      return take_call(id, params);
    }
    send_error(id, kNoMethod, "there is no method " + method);
  }

  json greet(const json& params) {
    const json wanted = params.value("protocolVersion", json());
    const auto* const version =
        std::find_if(kVersions.begin(), kVersions.end(), [&](auto one) { return wanted == one; });
    const json abilities = params.value("capabilities", json::object());
    {
      const std::lock_guard guard(mutex_);
      can_ask_ = abilities.is_object() && abilities.contains("elicitation");
    }
    return {
        {"protocolVersion", version == kVersions.end() ? kVersions.front() : *version},
        {"capabilities", {{"tools", json::object()}}},
        {"serverInfo", {{"name", "snapthrough"}, {"title", "snapthrough"}, {"version", SNAPTHROUGH_VERSION}}},
        {"instructions", kInstructions}};
  }

  void take_call(const json& id, const json& params) {
    const json name = params.value("name", json());
    const json arguments = params.value("arguments", json::object());
    if (!name.is_string() || !Tools::has(name.get<std::string>())) {
      return send_error(id, kInvalidParameters, "there is no tool " + name.dump());
    }
    if (!arguments.is_object()) {
      return send_error(id, kInvalidParameters, "the arguments of a tool are an object");
    }
    const json meta = params.value("_meta", json::object());
    const std::lock_guard guard(mutex_);
    calls_.push_back({id, name.get<std::string>(), arguments,
                      meta.is_object() ? meta.value("progressToken", json()) : json()});
    changed_.notify_all();
  }

  /// Stops a call; the client wants no answer to it.
  void cancel(const json& id) {
    const std::lock_guard guard(mutex_);
    for (const Call& call : calls_) {
      if (call.id == id) {
        std::stop_source(call.stop).request_stop();  // shares its state
      }
    }
  }

  void take_answer(const json& id, const json& message) {
    const std::lock_guard guard(mutex_);
    const auto question = id.is_number_integer() ? questions_.find(id.get<int>()) : questions_.end();
    if (question != questions_.end()) {
      question->second = message;
      changed_.notify_all();
    }
  }

  Dialogue::Answer ask(const std::string& text, const json& schema, const std::stop_token& stop) {
    using Answer = Dialogue::Answer;
    std::unique_lock lock(mutex_);
    if (!can_ask_) {
      return {};
    }
    const int id = ++asked_;
    questions_.emplace(id, nullptr);
    lock.unlock();
    send({{"jsonrpc", "2.0"},
          {"id", id},
          {"method", "elicitation/create"},
          {"params", {{"message", text}, {"requestedSchema", schema}}}});
    lock.lock();
    changed_.wait(lock, stop, [&] { return !questions_.at(id).is_null(); });
    const json message = questions_.extract(id).mapped();
    const json result = message.is_object() ? message.value("result", json::object()) : json::object();
    const bool given = result.is_object() && result.value("action", json()) == "accept" &&
                       result.contains("content") && result.at("content").is_object();
    return given ? Answer{Answer::Kind::given, result.at("content").dump()} : Answer{Answer::Kind::refused};
  }

  /// Computes the calls, one after the other, until the session ends.
  void work(const Surroundings& around) {
    Tools tools(around);
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return ended_ || !calls_.empty(); });
      if (calls_.empty()) {
        return;
      }
      const Call& call = calls_.front();  // later calls do not move it
      lock.unlock();
      answer(tools, call);
      lock.lock();
      calls_.pop_front();
    }
  }

  void answer(Tools& tools, const Call& call) {
    json result;
    try {
      Voice voice(*this, call);
      if (!call.stop.stop_requested()) {
        result = tools.call(call.tool, call.arguments, voice);
      }
    } catch (const std::exception& error) {
      return send_error(call.id, kInternalError, error.what());
    }
    if (!call.stop.stop_requested()) {
      send_result(call.id, std::move(result));
    }
  }

  /// Lets the calls that wait be answered unless they ask; a client that closes its side may still read.
  void end() {
    {
      const std::lock_guard guard(mutex_);
      ended_ = true;
      can_ask_ = false;
      for (auto& [id, answer] : questions_) {
        answer = json::object();
      }
    }
    changed_.notify_all();
    worker_.join();
  }

  void send_result(const json& id, json result) {
    send({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}});
  }
  void send_error(const json& id, int code, const std::string& message) {
    send({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}});
  }
  void send(const json& message) {
    const std::string text = message.dump(-1, ' ', false, json::error_handler_t::replace);
    const std::lock_guard guard(out_mutex_);
    out_ << text << '\n' << std::flush;
  }

  std::istream& in_;
  std::ostream& out_;
  std::mutex out_mutex_;
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any changed_;
  std::deque<Call> calls_;
  std::map<int, json> questions_;  ///< answers by number of the question; null: none so far
  int asked_ = 0;
  bool can_ask_ = false;
  bool ended_ = false;
  std::jthread worker_;
};

}  // namespace

void serve_session(std::istream& in, std::ostream& out, Surroundings around) {
  Session(in, out, std::move(around)).run();
}

}  // namespace snapthrough::server::mcp
