// Stock removal against a profile as the target's own cycle.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "ir/passes/machining_moves.h"
#include "ir/passes/similar_cycles.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::LeftContours;
using cycles::ProfileElement;
using cycles::TurnMove;
using cycles::TurnNumbers;
using cycles::TurnPoint;
using cycles::TurnStep;

constexpr double tiny = 1e-6;  // mm

bool same(const TurnPoint& a, const TurnPoint& b) {
  return std::abs(a.x - b.x) < tiny && std::abs(a.z - b.z) < tiny;
}
bool same(const std::vector<ProfileElement>& a, const std::vector<ProfileElement>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& u, const auto& v) {
    return same(u.from, v.from) && same(u.to, v.to) && u.arc == v.arc &&
           (!u.arc || (u.ccw == v.ccw && same(u.centre, v.centre)));
  });
}

/// What a cycle does, by numbers.
struct Played {
  std::vector<TurnMove> moves;
  LeftContours left;

  [[nodiscard]] double height(TurnPoint t) const { return left.out * (left.face ? t.z : t.x); }
  /// Of the first pass.
  [[nodiscard]] double first_pass() const {
    for (const auto& m : moves) {
      if (m.step == TurnStep::feed) return height(m.to);
    }
    return -std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] double top() const {
    double p = -std::numeric_limits<double>::infinity();
    for (const auto& e : left.rough) p = std::max({p, height(e.from), height(e.to)});
    return p;
  }
  [[nodiscard]] int passes() const {
    int n = 0;
    bool rapid = true;
    for (const auto& m : moves) {
      const bool cut = m.step == TurnStep::feed || m.step == TurnStep::arc;
      if (cut && rapid) ++n;
      rapid = m.step == TurnStep::rapid || (rapid && !cut);
    }
    return n;
  }
};

class StockForms {
 public:
  StockForms(const SimilarSource& source, std::string* why) : s_(source), why_(*why) {}

  std::optional<SimilarForm> find() {
    if (s_.profile == nullptr) return no("its profile is not known");
    if (std::isnan(s_.at.x) || std::isnan(s_.at.z) || !s_.start.x || !s_.start.z)
      return no("the place of the tool before it is not known here");
    if (!play(s_.named, mine_)) return std::nullopt;
    if (has("section") && !is_zero("section")) return no("it works in sections");
    if (!is_zero("chip_dwell") || !is_zero("chip_length")) return no("it breaks chips");
    std::vector<NamedCycle> forms;
    contour_forms(forms);
    if (forms.empty()) return no("the target has none of its kind");
    for (const auto& form : forms) {
      Played theirs;
      if (!play(form, theirs) || !leaves_the_same(theirs)) continue;
      return written(form, theirs);
    }
    return std::nullopt;
  }

 private:
  std::nullopt_t no(std::string text) {
    if (why_.empty()) why_ = std::move(text);
    return std::nullopt;
  }
  [[nodiscard]] const Value* find_word(std::string_view name) const {
    for (const auto& [w, v] : s_.named.words) {
      if (w == name) return &v;
    }
    return nullptr;
  }
  [[nodiscard]] bool has(std::string_view name) const { return find_word(name) != nullptr; }
  [[nodiscard]] std::optional<double> number(std::string_view name) const {
    const auto* v = find_word(name);
    if (v == nullptr) return 0;
    const Value f = s_.fold(*v);
    return f.literal() ? std::optional(f.number) : constant_value(f.expr);
  }
  [[nodiscard]] bool is_zero(std::string_view name) const { return number(name) == 0.0; }

  /// By numbers; words that only the run knows are taken as something usual, the same on both sides.
  bool play(const NamedCycle& cycle, Played& out) {
    NamedCycle folded;
    folded.name = cycle.name;
    for (const auto& [w, v] : cycle.words) {
      if (w == "contour" || w.starts_with("contour_")) continue;
      Value f = s_.fold(v);
      const bool text = w.ends_with("_label") || w == "routine";
      if (!text && !f.literal() && !constant_value(f.expr)) {
        if (w != "step" && w != "axial_step" && !w.starts_with("stock") && !w.ends_with("_feed") && w != "withdrawal")
          return no("its words are computed when the program runs"), false;
        const double k = w.ends_with("_feed") ? 1e-3 : w.starts_with("stock") ? 0.5 : 1;
        f = Value(k * (1 + double(w.size()) / 1e3));
        computed_ = true;
      }
      folded.words.emplace_back(w, f);
    }
    TurnNumbers numbers;
    if (!machining_numbers(folded, s_.modes, numbers)) return no("its words are computed when the program runs"), false;
    cycles::TurnContext context;
    context.start = s_.at;
    context.nose_width = s_.nose_width;
    context.longer_in_x = s_.longer_in_x;
    context.profile = s_.profile;
    context.left = &out.left;
    std::string error;
    auto moves = cycles::expand(*cycles::find_machining(cycle.name), numbers, context, &error);
    if (!moves) return no(error), false;
    out.moves = std::move(*moves);
    if (&out == &mine_) numbers_ = std::move(numbers);
    return true;
  }

  bool leaves_the_same(const Played& theirs) {
    if (theirs.left.face != mine_.left.face || theirs.left.out != mine_.left.out ||
        !same(theirs.left.rough, mine_.left.rough) || !same(theirs.left.finish, mine_.left.finish))
      return no("the target's cycle would come to another contour"), false;
    if (mine_.left.rough.empty()) return true;
    for (const auto& e : mine_.left.rough) {
      if (mine_.height(e.to) < mine_.height(e.from) - tiny)
        return no("its contour has a recess, and the target's cycle leaves steps on the far side of one"), false;
    }
    const double high = mine_.first_pass() - theirs.top();
    if (high > tiny && !computed_)
      return no("the blank stands " + shortest(std::round(high * 1e3) / 1e3) +
                " mm and more over the highest point of the contour, where the target's cycle begins"),
             false;
    return true;
  }

  // --- against the contour alone --------------------------------------------------------------------------------

  void contour_forms(std::vector<NamedCycle>& forms) {
    if (s_.named.name == "stock.contour") return;
    NamedCycle f;
    f.name = "stock.contour";
    if (!s_.target.native_cycle(Cycle{f})) return;
    const auto put = [&](std::string_view name, const Value* v) {
      if (v != nullptr) f.words.emplace_back(std::string(name), plain(*v));
    };
    const bool by_blank = s_.named.name == "stock.blank";
    if (!s_.feed) {
      no("the feed in force before it is not known here");
      return;
    }
    f.words.emplace_back("first_label", Value(1.0));
    f.words.emplace_back("last_label", Value(2.0));
    put("step", find_word(has("axial_step") ? "axial_step" : "step"));
    if (by_blank || has("stock_z")) {
      put("stock_z", find_word("stock_z"));
      put("stock_x", find_word("stock_x"));
    } else {
      put("stock", find_word("stock_x"));
    }
    const bool finishes = !mine_.left.finish.empty();
    f.words.emplace_back("rough_feed", plain(*s_.feed));
    const Value* groove = is_zero("groove_feed") ? nullptr : find_word("groove_feed");
    f.words.emplace_back("groove_feed", plain(groove != nullptr ? *groove : *s_.feed));
    if (finishes) put("finish_feed", find_word("finish_feed"));
    const bool above = s_.at.x > (lowest_x() + highest_x()) / 2;
    std::array<double, 2> kinds = mine_.left.face ? std::array{2.0, 4.0} : std::array{1.0, 3.0};
    if (!above) std::swap(kinds[0], kinds[1]);
    for (const double kind : kinds) {
      NamedCycle g = f;
      g.words.emplace_back("variant", Value(finishes ? kind + 8 : kind));
      const Value* lift = is_zero("withdrawal") ? nullptr : find_word("withdrawal");
      if (lift != nullptr) g.words.emplace_back("withdrawal", plain(*lift));
      forms.push_back(std::move(g));
    }
  }
  [[nodiscard]] double highest_x() const {
    double x = -std::numeric_limits<double>::infinity();
    for (const auto& e : s_.profile->part) x = std::max({x, e.from.x, e.to.x});
    return x;
  }
  [[nodiscard]] double lowest_x() const {
    double x = std::numeric_limits<double>::infinity();
    for (const auto& e : s_.profile->part) x = std::min({x, e.from.x, e.to.x});
    return x;
  }
  /// Without the source's spelling; a number without its sign: what a length or a feed is counted by.
  static Value plain(const Value& v) {
    if (v.literal()) return Value(std::fabs(v.number));
    Value out = v;
    out.text = {};
    return out;
  }

  [[nodiscard]] SimilarForm written(const NamedCycle& form, const Played& theirs) const {
    SimilarForm out;
    out.cycle = form;
    out.after = s_.start;
    const auto* own = cycles::find_machining(s_.named.name);
    out.rapid_stays = own->ends_modes;
    if (own->ends_modes) out.feed = last_feed();
    const int a = mine_.passes(), b = theirs.passes();
    const auto one = [](int n) { return std::to_string(n) + (n == 1 ? " pass" : " passes"); };
    if (!computed_) out.differs = one(b) + " instead of " + one(a) + ", ";
    const TurnPoint from = theirs.moves.empty() ? TurnPoint{} : theirs.moves.front().to;
    const double k = s_.modes.diameter == DiameterMode::radius ? 1 : 2;
    const auto shown = [](double v) { return shortest(std::round(v * 1e3) / 1e3 + 0.0); };
    if (!theirs.moves.empty() && theirs.moves.front().step == TurnStep::rapid)
      out.differs += "from X" + shown(from.x * k) + " Z" + shown(from.z) +
                     " (1 mm off the contour; nothing of the blank may stand there)";
    if (has("rough_feed") && !is_zero("rough_feed")) out.differs += ", without the pass before finishing";
    return out;
  }
  /// The feed that the source's cycle leaves in force.
  [[nodiscard]] std::optional<Value> last_feed() const {
    const auto last = std::find_if(mine_.moves.rbegin(), mine_.moves.rend(), [](const auto& m) { return m.has_feed; });
    if (last == mine_.moves.rend()) return std::nullopt;
    for (const std::string_view name : {"finish_feed", "rough_feed", "groove_feed"}) {
      const auto it = numbers_.find(name);
      if (it != numbers_.end() && it->second == last->feed) return plain(*find_word(name));
    }
    return std::nullopt;
  }

  const SimilarSource& s_;
  std::string& why_;
  Played mine_;
  TurnNumbers numbers_;
  bool computed_ = false;
};

}  // namespace

std::optional<SimilarForm> similar_stock(const SimilarSource& source, std::string* why) {
  return StockForms(source, why).find();
}

void keep_used(const Program& program, const std::vector<ProfileUse>& uses, std::set<std::uint32_t>& blocks) {
  for (const auto& use : uses) {
    for (const auto& r : program.routines) {
      bool inside = false;
      for (const auto& s : r.body) {
        inside = inside || s.id == use.first;
        if (inside) blocks.erase(s.id);
        if (s.id == use.last) inside = false;
      }
    }
  }
}

void label_profiles(Program& program, const std::vector<ProfileUse>& uses) {
  std::vector<ProfileUse> done;
  for (const auto& use : uses) {
    if (std::find(done.begin(), done.end(), use) != done.end()) continue;
    done.push_back(use);
    for (auto& r : program.routines) {
      for (std::size_t i = 0; i < r.body.size(); ++i) {
        if (r.body[i].id == use.last) set_label(r.body[i].line, LabelRef{use.last_label, false, nullptr}, program);
        if (r.body[i].id != use.first) continue;
        const LabelRef label{use.first_label, false, nullptr};
        if (!use.x || !use.z) {
          set_label(r.body[i].line, label, program);
          continue;
        }
        Block b;
        b.has_motion = true;
        b.motion.kind = MotionKind::linear;
        b.motion.explicit_code = true;
        for (const auto& [axis, v] : {std::pair(axis::x, *use.x), std::pair(axis::z, *use.z)}) {
          CoordWord w;
          w.axis = axis;
          w.value = v;
          b.motion.coords.push_back(w);
        }
        Statement s = made(r.body[i].line, std::move(b));
        set_label(s.line, label, program);
        r.body.insert(r.body.begin() + static_cast<std::ptrdiff_t>(i), std::move(s));
        ++i;
      }
    }
  }
}

}  // namespace cnctrans::ir::passes
