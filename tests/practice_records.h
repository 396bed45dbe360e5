// The records of a practice case: six operating points, each a file of p and q at 5 kHz.
#ifndef HOWL_TESTS_PRACTICE_RECORDS_H_
#define HOWL_TESTS_PRACTICE_RECORDS_H_

#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "estimation/analysis/analyse.h"

namespace howl {

inline std::vector<NamedRecord> PracticeRecords(const std::string& folder) {
  std::vector<NamedRecord> out;
  for (const double phi : {0.56, 0.53, 0.51, 0.49, 0.47, 0.45}) {
    NamedRecord each;
    each.name = "exp" + std::to_string(out.size() + 1);
    each.phi = phi;
    each.record.sampling_hz = 5000.0;
    std::ifstream file(folder + "/data/" + each.name + ".csv");
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      char* end = nullptr;
      each.record.pressure.push_back(std::strtod(line.c_str(), &end));
      each.record.heat_release.push_back(std::strtod(end + 1, nullptr));
    }
    out.push_back(std::move(each));
  }
  return out;
}

}  // namespace howl

#endif  // HOWL_TESTS_PRACTICE_RECORDS_H_
