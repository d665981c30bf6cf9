// SPDX-License-Identifier: BSD-3-Clause
#include "kappa/io/las/file.hpp"

namespace kappa {

std::shared_ptr<const FileRecords> LasFile::picked(const std::vector<Index>& kept, const Execution& run) const {
  auto chosen = std::make_shared<LasFile>();
  chosen->header = header;
  chosen->format = format;
  chosen->record_length = record_length;
  chosen->scale = scale;
  chosen->offset = offset;
  chosen->records = records;
  chosen->gap = gap;
  chosen->extended = extended;
  chosen->waveform = waveform;
  chosen->points.reserve(kept.size() * record_length);
  constexpr std::size_t kBlock = 16384;
  serial_for(kept.size(), kBlock, run, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) chosen->points.append(points, kept[k] * record_length, record_length);
  });
  return chosen;
}

const LasFile* las_of(const Scan& scan) {
  return dynamic_cast<const LasFile*>(scan.records.get());
}

bool LasRecord::is(const std::string& user, std::uint16_t wanted) const {
  return id == wanted && user_id.substr(0, user_id.find('\0')) == user;
}

}  // namespace kappa
