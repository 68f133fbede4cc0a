#include "server/metrics/metrics.h"

#include <algorithm>
#include <charconv>

namespace snapthrough::server {
namespace {

std::string number(double value) {
  std::array<char, 40> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

void write_head(std::string& text, std::string_view name, std::string_view type, std::string_view help) {
  text.append("# HELP ").append(name).append(" ").append(help).append("\n# TYPE ").append(name);
  text.append(" ").append(type).append("\n");
}

void write_sample(std::string& text, std::string_view name, const std::string& labels, double value) {
  text.append(name);
  if (!labels.empty()) {
    text.append("{").append(labels).append("}");
  }
  text.append(" ").append(number(value)).append("\n");
}

}  // namespace

std::string label(std::string_view name, std::string_view value) {
  std::string text = std::string(name) + "=\"";
  for (const char c : value) {
    text += c == '\\' || c == '"' ? std::string{'\\', c} : c == '\n' ? "\\n" : std::string{c};
  }
  return text + "\"";
}

void Counter::add(const std::string& labels) {
  const std::lock_guard guard(mutex_);
  ++counts_[labels];
}

void Counter::write(std::string& text) const {
  write_head(text, name_, "counter", help_);
  const std::lock_guard guard(mutex_);
  for (const auto& [labels, count] : counts_) {
    write_sample(text, name_, labels, static_cast<double>(count));
  }
}

void Histogram::observe(double seconds, const std::string& labels) {
  const auto bucket = std::lower_bound(kBounds.begin(), kBounds.end(), seconds) - kBounds.begin();
  const std::lock_guard guard(mutex_);
  Series& series = series_[labels];
  ++series.counts[static_cast<std::size_t>(bucket)];
  series.sum += seconds;
}

void Histogram::write(std::string& text) const {
  const std::string name(name_);
  write_head(text, name_, "histogram", help_);
  const std::lock_guard guard(mutex_);
  for (const auto& [labels, series] : series_) {
    double below = 0.0;  // buckets are cumulative in this format
    for (std::size_t i = 0; i < series.counts.size(); ++i) {
      below += static_cast<double>(series.counts[i]);
      const std::string bound = label("le", i < kBounds.size() ? number(kBounds[i]) : "+Inf");
      write_sample(text, name + "_bucket", labels.empty() ? bound : labels + "," + bound, below);
    }
    write_sample(text, name + "_sum", labels, series.sum);
    write_sample(text, name + "_count", labels, below);
  }
}

void write_metric(std::string& text, std::string_view name, std::string_view type, std::string_view help,
                  double value) {
  write_head(text, name, type, help);
  write_sample(text, name, "", value);
}

}  // namespace snapthrough::server
