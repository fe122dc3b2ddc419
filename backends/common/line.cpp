#include "backends/common/line.h"

#include <algorithm>

namespace cnctrans::backends {

bool Line::has_column(std::uint32_t column) const {
  return column != 0 && std::any_of(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return p.column == column; });
}

std::string Line::text(bool by_rank) const {
  std::vector<const Piece*> order;
  order.reserve(pieces_.size());
  for (const Piece& p : pieces_) {
    if (by_rank || p.column != 0) order.push_back(&p);
  }
  if (by_rank) {
    std::stable_sort(order.begin(), order.end(), [](const Piece* a, const Piece* b) { return a->rank < b->rank; });
  } else {
    std::stable_sort(order.begin(), order.end(), [](const Piece* a, const Piece* b) { return a->column < b->column; });
    for (const Piece& p : pieces_) {
      if (p.column != 0) continue;
      const auto place = std::find_if(order.begin(), order.end(), [&](const Piece* o) { return o->rank > p.rank; });
      order.insert(place, &p);
    }
  }
  std::string text;
  for (const Piece* p : order) {
    if (p->text.empty()) continue;
    if (!text.empty()) text += ' ';
    text += p->text;
  }
  return text;
}

}  // namespace cnctrans::backends
