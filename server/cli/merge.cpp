#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "api/provenance.h"
#include "api/sweep_table.h"
#include "server/cli/commands.h"
#include "server/cli/part_file.h"

namespace snapthrough::server::cli {
namespace {

/// A part file and its number of rows.
struct PartRows {
  std::string path;
  SweepPart part;
  std::uint64_t first = 0;    ///< number of the part's first point
  std::uint64_t points = 0;   ///< number of the part's points
  std::uint64_t present = 0;  ///< number of rows in the file
};

/// Returns the name of a part in the syntax of --part.
std::string name_of(const SweepPart& part) {
  return std::to_string(part.number) + "/" + std::to_string(part.count);
}

/// Counts the rows of a part. @throws std::runtime_error when a row does not belong to the part
PartRows rows_of(PartReader& reader, const api::Sweep& sweep) {
  const ItemRange items = items_of(reader.part(), sweep);
  PartRows rows{reader.path(), reader.part(), items.first * sweep.item_size(),
                (items.end - items.first) * sweep.item_size(), 0};
  if (!sweep.refines()) {
    reader.require_outputs(sweep.output_count());
  }
  while (const auto row = reader.next()) {
    if (row->first != rows.first + rows.present || rows.present == rows.points) {
      throw std::runtime_error(rows.path + " has a row of point " + std::to_string(row->first) +
                               ", which is not the next one of part " + name_of(rows.part));
    }
    ++rows.present;
  }
  return rows;
}

/// Returns the sweep of the first file. @throws std::runtime_error when its document is invalid
api::Sweep sweep_of(const PartReader& reader) {
  api::SweepOutcome outcome = api::read_sweep_document(std::make_shared<nlohmann::json>(reader.document()));
  if (!outcome.sweep) {
    throw std::runtime_error(reader.path() + " holds a sweep document that this program does not accept: " +
                             outcome.findings.front().pointer + ": " + outcome.findings.front().detail);
  }
  return std::move(*outcome.sweep);
}

/// Returns the parts in their order. @throws std::runtime_error when the files are not parts of one split
std::vector<PartRows> parts_of(const std::vector<std::string>& paths, const nlohmann::json& document,
                               const api::Sweep& sweep) {
  std::vector<PartRows> parts;
  for (const std::string& path : paths) {
    PartReader reader(path);
    if (reader.document() != document) {
      throw std::runtime_error(path + " and " + paths.front() + " are of different sweep documents");
    }
    if (!parts.empty() && reader.part().count != parts.front().part.count) {
      throw std::runtime_error(path + " is part " + name_of(reader.part()) + ", and " + paths.front() +
                               " is part " + name_of(parts.front().part) + ": parts of one split are merged");
    }
    parts.push_back(rows_of(reader, sweep));
  }
  std::sort(parts.begin(), parts.end(),
            [](const PartRows& a, const PartRows& b) { return a.part.number < b.part.number; });
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].part == parts[i - 1].part) {
      throw std::runtime_error(parts[i - 1].path + " and " + parts[i].path + " are both part " +
                               name_of(parts[i].part));
    }
  }
  return parts;
}

/// Reports missing parts and rows on `err`, with the command for them. @return whether none is missing
bool all_there(const std::vector<PartRows>& parts, const Streams& streams) {
  bool complete = true;
  std::uint64_t next = 1;
  const auto absent = [&](std::uint64_t before) {
    for (; next < before; ++next) {
      streams.err << "snapthrough: no file holds part " << next << "/" << parts.front().part.count << '\n';
      complete = false;
    }
  };
  for (const PartRows& part : parts) {
    absent(part.part.number);
    next = part.part.number + 1;
    if (part.present < part.points) {
      streams.err << "snapthrough: " << part.path << " has " << part.present << " of " << part.points
                  << " rows; `sweep SWEEP --part " << name_of(part.part) << " --out " << part.path
                  << "` goes on with it\n";
      complete = false;
    }
  }
  absent(parts.front().part.count + 1);
  return complete;
}

}  // namespace

int merge_command(const std::vector<std::string>& paths, api::TableForm form, const Streams& streams) {
  const PartReader first(paths.front());
  const api::Sweep sweep = sweep_of(first);
  const std::vector<PartRows> parts = parts_of(paths, first.document(), sweep);
  if (!all_there(parts, streams)) {
    return kOther;
  }
  api::TableWriter writer(sweep, form, std::nullopt, api::provenance_members("table", first.document()));
  streams.out << writer.head();
  api::RowCounts counts;
  for (const PartRows& part : parts) {
    PartReader reader(part.path);
    while (const auto row = reader.next()) {
      std::string text;
      writer.append_row(row->first, row->second, text);
      streams.out << text;
      const api::RowCounts more = sweep.row_counts(row->first, row->second);
      counts.rows += more.rows;
      counts.failed += more.failed;
    }
  }
  std::string tail;
  writer.append_tail(tail);
  streams.out << tail << std::flush;
  if (!streams.out) {
    streams.err << "snapthrough: cannot write the rows\n";
    return kOther;
  }
  return told_failed(counts, streams);
}

}  // namespace snapthrough::server::cli
