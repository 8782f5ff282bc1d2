#pragma once

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <vector>

namespace pdc::detail {

/// Sorts a list, in parallel, and drops what is in it twice.
template <typename T>
void sortUnique(std::vector<T>& list) {
  tbb::parallel_sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace pdc::detail
