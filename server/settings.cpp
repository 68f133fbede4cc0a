#include "server/settings.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <numeric>
#include <sstream>

#include "server/key_settings.h"
#include "server/store/open_store.h"

namespace snapthrough::server {
namespace {

using Mistake = std::optional<std::string>;

template <class Number>
std::optional<Number> number(const std::string& text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Returns a setting that is an integer; `field` returns a reference to it.
template <class Field>
Setting whole(std::string name, std::string help, Field field) {
  using Value = std::remove_reference_t<decltype(field(std::declval<ServiceConfig&>()))>;
  return {std::move(name), std::move(help),
          [field](ServiceConfig& config, const std::string& text) -> Mistake {
            const std::optional<Value> value = number<Value>(text);
            if (!value) {
              return "expected a whole number, got " + text;
            }
            field(config) = *value;
            return std::nullopt;
          },
          [field](const ServiceConfig& config) {
            return std::to_string(field(const_cast<ServiceConfig&>(config)));  // only read
          },
          "INT"};
}

/// Returns a setting that is a duration in whole units of `Duration`.
template <class Field>
Setting duration(std::string name, std::string help, Field field) {
  using Duration = std::remove_reference_t<decltype(field(std::declval<ServiceConfig&>()))>;
  return {std::move(name), std::move(help),
          [field](ServiceConfig& config, const std::string& text) -> Mistake {
            const std::optional<std::int64_t> value = number<std::int64_t>(text);
            if (!value || *value < 0 || *value > std::numeric_limits<std::int32_t>::max()) {
              return "expected a whole number, 0 to 2147483647, got " + text;
            }
            field(config) = Duration(*value);
            return std::nullopt;
          },
          [field](const ServiceConfig& config) {
            return std::to_string(field(const_cast<ServiceConfig&>(config)).count());  // only read
          },
          "INT"};
}

std::string address_text(const std::string& host, int port) {
  const bool v6 = host.find(':') != std::string::npos;
  return (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

Setting listen_setting() {
  return {
      "listen", "Address and port, host:port; port 0 takes a free one; loopback only unless there are keys",
      [](ServiceConfig& config, const std::string& text) -> Mistake {
        const auto address = parse_address(text);
        if (!address) {
          return "expected host:port, got " + text;
        }
        std::tie(config.listener.host, config.listener.port) = *address;
        return std::nullopt;
      },
      [](const ServiceConfig& config) { return address_text(config.listener.host, config.listener.port); },
      "HOST:PORT"};
}

Setting observe_setting() {
  return {"observe",
          "host:port at which a process that only works answers /livez, /readyz and /metrics; empty: nowhere",
          [](ServiceConfig& config, const std::string& text) -> Mistake {
            config.observe = parse_address(text);
            return config.observe || text.empty() ? Mistake() : "expected host:port, got " + text;
          },
          [](const ServiceConfig& config) {
            return config.observe ? address_text(config.observe->first, config.observe->second) : "";
          },
          "HOST:PORT"};
}

Setting store_setting() {
  return {
      "store",
      "Database file, created if need be, its folder must exist; or a database that several processes share:"
      " postgresql://user@host/name",
      [](ServiceConfig& config, const std::string& text) -> Mistake {
        config.store_path = text;
        return std::nullopt;
      },
      [](const ServiceConfig& config) { return shown_location(config.store_path); }, "FILE|URL"};
}

/// Returns a setting that is a text. @param type what help shows in place of the value
template <class Field>
Setting text(std::string name, std::string help, std::string type, Field field) {
  return {std::move(name), std::move(help),
          [field](ServiceConfig& config, const std::string& value) -> Mistake {
            field(config) = value;
            return std::nullopt;
          },
          [field](const ServiceConfig& config) {
            return field(const_cast<ServiceConfig&>(config));  // only read
          },
          std::move(type)};
}

/// Returns a setting that is a list of texts, separated by commas.
template <class Field>
Setting text_list(std::string name, std::string help, Field field) {
  return {std::move(name), std::move(help),
          [field](ServiceConfig& config, const std::string& text) -> Mistake {
            std::vector<std::string>& list = field(config);
            list.clear();
            for (const std::string_view entry : http::split_list(text, ',')) {
              list.emplace_back(entry);
            }
            return std::nullopt;
          },
          [field](const ServiceConfig& config) {
            std::string text;
            for (const std::string& entry : field(const_cast<ServiceConfig&>(config))) {  // only read
              text += (text.empty() ? "" : ",") + entry;
            }
            return text;
          },
          "LIST"};
}

constexpr std::array kLevels{std::pair{LogLevel::debug, "debug"}, std::pair{LogLevel::info, "info"},
                             std::pair{LogLevel::warning, "warning"}, std::pair{LogLevel::error, "error"},
                             std::pair{LogLevel::off, "off"}};

Setting log_level_setting() {
  return {"log_level", "debug, info, warning, error or off",
          [](ServiceConfig& config, const std::string& text) -> Mistake {
            const auto level = log_level_from(text);
            if (!level) {
              return "expected debug, info, warning, error or off, got " + text;
            }
            config.log_level = *level;
            return std::nullopt;
          },
          [](const ServiceConfig& config) {
            const auto* row = std::find_if(kLevels.begin(), kLevels.end(), [&](const auto& level) {
              return level.first == config.log_level;
            });
            return std::string(row->second);
          },
          "LEVEL"};
}

std::vector<Setting> front_settings() {
  return {
      listen_setting(),
      observe_setting(),
      whole("threads", "Requests worked on at the same time",
            [](ServiceConfig& c) -> int& { return c.listener.threads; }),
      whole("max_connections", "Open connections; the next is refused with 503",
            [](ServiceConfig& c) -> int& { return c.listener.connections; }),
      whole("max_streams", "Streams of events; the next is refused with 503",
            [](ServiceConfig& c) -> int& { return c.listener.streams; }),
      whole("max_body_bytes", "Size of a request body",
            [](ServiceConfig& c) -> std::size_t& { return c.listener.limits.body_bytes; }),
      whole("max_head_bytes", "Size of request line and headers",
            [](ServiceConfig& c) -> std::size_t& { return c.listener.limits.head_bytes; }),
      whole("max_buffered_bytes", "Of all incomplete requests and responses that are being sent, together",
            [](ServiceConfig& c) -> std::size_t& { return c.listener.limits.buffered_bytes; }),
      duration(
          "idle_timeout_ms", "Until the first byte of a request",
          [](ServiceConfig & c) -> auto& { return c.listener.times.idle; }),
      duration(
          "head_timeout_ms", "For the headers of a request",
          [](ServiceConfig & c) -> auto& { return c.listener.times.head; }),
      duration(
          "body_timeout_ms", "For the body of a request",
          [](ServiceConfig & c) -> auto& { return c.listener.times.body; }),
      duration(
          "send_timeout_ms", "For a client to take some of a response",
          [](ServiceConfig & c) -> auto& { return c.listener.times.send; }),
      duration(
          "default_wait_s", "Wait for a result when the client does not say",
          [](ServiceConfig & c) -> auto& { return c.waits.default_wait; }),
      duration(
          "longest_wait_s", "Wait in one request at most",
          [](ServiceConfig & c) -> auto& { return c.waits.longest_wait; }),
      duration(
          "drain_delay_s", "From SIGTERM, when /readyz turns 503, until running work is given back",
          [](ServiceConfig & c) -> auto& { return c.drain_delay; }),
      text_list("allowed_origins",
                "Origins of pages that may use the service, too, exact, with commas between; none: its own",
                [](ServiceConfig& c) -> std::vector<std::string>& { return c.allowed_origins; }),
      text_list("callback_hosts",
                "Hosts, host[:port], that may be told of the end of jobs, with commas between; none: refused",
                [](ServiceConfig& c) -> std::vector<std::string>& { return c.jobs.callback_hosts; }),
      text("callback_secret_file", "File with the secret that callbacks are signed with: whsec_ and base64",
           "FILE", [](ServiceConfig& c) -> std::string& { return c.callback_secret_file; }),
      text("web", "The page at /: built-in, none (as --no-web), or a folder that is read at every request",
           "built-in|none|FOLDER", [](ServiceConfig& c) -> std::string& { return c.web; }),
      text("hops_folder",
           "Folder with a sweep document NAME.json for each component of Grasshopper; empty: built-in ones",
           "FOLDER", [](ServiceConfig& c) -> std::string& { return c.hops_folder; }),
      log_level_setting(),
  };
}

std::vector<Setting> job_settings() {
  return {
      store_setting(),
      whole("store_connections", "Connections to a database beside one for each worker",
            [](ServiceConfig& c) -> int& { return c.store_connections; }),
      whole("workers", "Analyses at the same time; 0: other processes that share the store work",
            [](ServiceConfig& c) -> int& { return c.workers; }),
      whole("spare_workers",
            "Most analyses beside those of the workers: for owners for whom nothing runs while all workers "
            "are busy",
            [](ServiceConfig& c) -> int& { return c.jobs.spare_workers; }),
      whole("max_queue", "Jobs that may wait; the next is refused with 429",
            [](ServiceConfig& c) -> int& { return c.jobs.queue; }),
      whole("max_sweeps", "Sweeps that may be unfinished; the next is refused with 429",
            [](ServiceConfig& c) -> int& { return c.jobs.sweeps; }),
      whole("max_sweep_points", "Points of a sweep, up to 1000000",
            [](ServiceConfig& c) -> int& { return c.jobs.sweep_points; }),
      whole(
          "max_json_keys",
          "Keys in all objects of a request or sweep; memory is taken for each; the next is refused with 400",
          [](ServiceConfig& c) -> std::size_t& { return c.jobs.json_keys; }),
      whole("max_table_rows", "Rows of a sweep's table in one response",
            [](ServiceConfig& c) -> int& { return c.jobs.table_rows; }),
      whole("quota_jobs_waiting",
            "Jobs of one owner that may wait; the next is refused with 429; 0: any number",
            [](ServiceConfig& c) -> std::int64_t& { return c.jobs.quotas.jobs_waiting; }),
      whole("quota_points_waiting", "Points of one owner's sweeps that may wait, else 429; 0: any number",
            [](ServiceConfig& c) -> std::int64_t& { return c.jobs.quotas.points_waiting; }),
      whole(
          "quota_points_per_hour",
          "Points of sweeps that one owner may hand in or try again within an hour, else 429; 0: any number",
          [](ServiceConfig& c) -> std::int64_t& { return c.jobs.quotas.points_per_hour; }),
      whole("quota_bytes_kept", "Documents of one owner that are kept, else 403; 0: any size",
            [](ServiceConfig& c) -> std::int64_t& { return c.jobs.quotas.bytes_kept; }),
      whole("max_crashes", "A job during which the service died so often is given up",
            [](ServiceConfig& c) -> int& { return c.jobs.max_crashes; }),
      duration(
          "lease_s", "A worker that is silent for so long has lost its job",
          [](ServiceConfig & c) -> auto& { return c.jobs.lease; }),
      duration(
          "max_run_s", "Time of one analysis", [](ServiceConfig & c) -> auto& { return c.jobs.longest_run; }),
      whole("max_job_memory_bytes", "Memory of one analysis, its result document included",
            [](ServiceConfig& c) -> std::int64_t& { return c.jobs.job_memory; }),
      duration(
          "keep_jobs_s", "How long jobs are kept after their end; 0: for ever",
          [](ServiceConfig & c) -> auto& { return c.jobs.keep_jobs; }),
      duration(
          "keep_keys_s", "How long idempotency keys are known",
          [](ServiceConfig & c) -> auto& { return c.jobs.keep_keys; }),
      duration(
          "keep_records_s",
          "How long usage and events of owners are kept (/v1/usage, /v1/audit); 0: for ever",
          [](ServiceConfig & c) -> auto& { return c.jobs.keep_records; }),
      whole("ballast_bytes", "Reserve on the disk of the store; 0: none",
            [](ServiceConfig& c) -> std::int64_t& { return c.ballast_bytes; }),
      whole("least_free_bytes", "With less on the disk of the store no jobs are taken",
            [](ServiceConfig& c) -> std::int64_t& { return c.least_free_bytes; }),
  };
}

const Setting* find_setting(const std::string& name) {
  const std::vector<Setting>& all = settings();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Setting& s) { return s.name == name; });
  return found == all.end() ? nullptr : &*found;
}

/// Returns the edit distance: least number of inserted, deleted and replaced characters.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);  // distances from a beginning of `from` to those of `to`
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

/// @param form returns a setting's name in the syntax of the source
template <class Form>
std::string no_such_setting(const std::string& name, const Form& form) {
  std::vector<std::string> known;
  for (const Setting& setting : settings()) {
    known.push_back(form(setting.name));
  }
  return "there is no such setting; the nearest is " +
         *std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
           return edit_distance(name, a) < edit_distance(name, b);
         });
}

void read_file(const std::string& file, ServiceConfig& config, std::vector<ConfigMistake>& mistakes) {
  toml::table parsed;
  try {
    parsed = toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    std::ostringstream text;
    text << error;
    mistakes.push_back({file, text.str()});
    return;
  }
  for (const auto& [key, node] : parsed) {
    const std::string name(key.str());
    const Setting* setting = find_setting(name);
    const std::string where = place(file, node) + ": " + name;
    if (name == "keys") {
      read_keys(node, file, config.keys, mistakes);
    } else if (setting == nullptr) {
      mistakes.push_back({where, no_such_setting(name, [](const std::string& known) { return known; })});
    } else if (!node.is_string() && !node.is_integer()) {
      mistakes.push_back({where, "expected a text or a whole number"});
    } else {
      const std::string value = node.is_string() ? **node.as_string() : std::to_string(**node.as_integer());
      if (const Mistake mistake = setting->set(config, value)) {
        mistakes.push_back({where, *mistake});
      }
    }
  }
}

void read_environment(const std::map<std::string, std::string>& variables, ServiceConfig& config,
                      std::vector<ConfigMistake>& mistakes) {
  for (const auto& [name, value] : variables) {
    const auto setting = std::find_if(settings().begin(), settings().end(),
                                      [&](const Setting& one) { return variable_name(one.name) == name; });
    if (setting == settings().end() && name != kConfigVariable) {
      mistakes.push_back({name, no_such_setting(name, variable_name)});
    } else if (const Mistake mistake =
                   setting != settings().end() ? setting->set(config, value) : std::nullopt) {
      mistakes.push_back({name, *mistake});
    }
  }
}

}  // namespace

std::string variable_name(const std::string& setting) {
  std::string name = std::string(kVariablePrefix) + setting;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return name;
}

const std::vector<Setting>& settings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> list = front_settings();
    const std::vector<Setting> jobs = job_settings();
    list.insert(list.end(), jobs.begin(), jobs.end());
    return list;
  }();
  return all;
}

std::pair<ServiceConfig, std::vector<ConfigMistake>> load_config(const SettingSources& sources, bool front) {
  ServiceConfig config = ServiceConfig::defaults();
  config.front = front;
  std::vector<ConfigMistake> mistakes;
  if (!sources.file.empty()) {
    read_file(sources.file, config, mistakes);
  }
  read_environment(sources.environment, config, mistakes);
  for (const auto& [name, value] : sources.flags) {
    const Setting* setting = find_setting(name);
    if (const Mistake mistake = setting != nullptr ? setting->set(config, value) : Mistake("unknown")) {
      std::string flag = "--" + name;
      std::replace(flag.begin(), flag.end(), '_', '-');
      mistakes.push_back({flag, *mistake});
    }
  }
  if (mistakes.empty()) {
    mistakes = config.check();
  }
  return {std::move(config), std::move(mistakes)};
}

}  // namespace snapthrough::server
