#pragma once

namespace pdc {

/// Asks the system to back the heap with huge pages. The millions of nodes of a large grid lie in small pages
/// otherwise, each of which the system makes when it is first touched, which takes longer than reading the file. Where
/// the C library or the system knows no such thing nothing happens. Call it before anything is allocated.
void useHugePagesForHeap();

}  // namespace pdc
