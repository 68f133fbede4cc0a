#include "server/store/postgresql/row_pack.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "server/store/postgresql/rows.h"

namespace snapthrough::server::postgresql {

std::string pack_rows(const std::vector<PointRow>& rows) {
  // Column by column, which packs better; an empty text where there is nothing.
  nlohmann::json columns{{"point", nlohmann::json::array()},
                         {"outputs", nlohmann::json::array()},
                         {"code", nlohmann::json::array()},
                         {"detail", nlohmann::json::array()},
                         {"key", nlohmann::json::array()}};
  std::uint64_t last = 0;
  for (const PointRow& row : rows) {
    columns["point"].push_back(static_cast<std::int64_t>(row.point - last));  // mostly 1
    last = row.point;
    // bytes: a detail need not be UTF-8
    const auto bytes = [](const std::string& text) {
      return nlohmann::json::binary({text.begin(), text.end()});
    };
    columns["outputs"].push_back(bytes(row.outcome.outputs));
    columns["code"].push_back(bytes(row.outcome.code));
    columns["detail"].push_back(bytes(row.outcome.detail));
    columns["key"].push_back(bytes(row.key));
  }
  std::string cbor;
  nlohmann::json::to_cbor(columns, cbor);
  return packed(cbor);
}

std::vector<PointRow> unpack_rows(std::string_view bytes) try {
  const nlohmann::json columns = nlohmann::json::from_cbor(unpacked(bytes));
  std::vector<PointRow> rows(columns.at("point").size());
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto text = [&](const char* column) {
      const auto& binary = columns.at(column).at(i).get_binary();
      return std::string(binary.begin(), binary.end());
    };
    last += static_cast<std::uint64_t>(columns.at("point").at(i).get<std::int64_t>());
    rows[i] = {last, {text("outputs"), text("code"), text("detail")}, text("key")};
  }
  return rows;
} catch (const nlohmann::json::exception& error) {
  throw Error("XX001", std::string("rows of a sweep in the store are damaged: ") + error.what());
}

std::int64_t short_key(std::string_view key) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, which gives the same on every host
  for (const char c : key) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  return static_cast<std::int64_t>(hash);
}

std::vector<std::int64_t> short_keys(const std::vector<PointRow>& rows) {
  std::vector<std::int64_t> keys;
  for (const PointRow& row : rows) {
    if (!row.outcome.failed() && !row.key.empty() && !row.reused) {
      keys.push_back(short_key(row.key));
    }
  }
  return keys;
}

}  // namespace snapthrough::server::postgresql
