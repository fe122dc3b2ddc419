// Stock removal against a profile as the target's own cycle.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "ir/cycles/turning/left_material.h"
#include "legaliser/cycles/turning/machining_moves.h"
#include "legaliser/cycles/turning/similar_cycles.h"

namespace cnctrans::ir::passes {

namespace {

using cycles::LeftContours;
using cycles::ProfileElement;
using cycles::TurnMove;
using cycles::TurnNumbers;
using cycles::TurnPoint;
using cycles::TurnStep;

constexpr double same_place = 1e-6;  // mm

bool same(const TurnPoint& a, const TurnPoint& b) {
  return std::abs(a.x - b.x) < same_place && std::abs(a.z - b.z) < same_place;
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
    const bool anywhere = s_.named.name == "stock.contour";
    if (!anywhere && (std::isnan(s_.at.x) || std::isnan(s_.at.z) || !s_.start.x || !s_.start.z))
      return no("the place of the tool before it is not known here");
    if (!play(s_.named, mine_)) return std::nullopt;
    if (has("section") && !is_zero("section")) return no("it works in sections");
    if (s_.named.name == "turn.copy") return no("it repeats the profile, and the target's cycle makes straight passes");
    // CYCLE95 follows the contour behind each of its passes; of the others the last roughing pass would be missing.
    semi_finish_ = cycles::find_machining(s_.named.name)->ends_modes && has("rough_feed") && !is_zero("rough_feed");
    if (!is_zero("chip_dwell") || !is_zero("chip_length")) return no("it breaks chips");
    std::vector<NamedCycle> forms;
    contour_forms(forms);
    profile_forms(forms);
    if (forms.empty()) return no("no cycle of the target is written for its kind");
    for (const auto& form : forms) {
      if (semi_finish_ && form.name != "stock.contour")
        return no("the target's cycle has no pass along the contour before finishing");
      Played theirs;
      if (!play(form, theirs)) continue;
      from_the_tool_ = form.name != "stock.contour";
      if (leaves_the_same(theirs)) return written(form, theirs);
      if (from_the_tool_) continue;
      if (auto longer = with_tail(form)) return longer;
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
        if (w.starts_with("stock") && s_.named.name == "stock.blank")
          return no("the sense of its allowance is known only when the program runs"), false;
        const double k = w.ends_with("_feed") ? 1e-3 : w.starts_with("stock") ? 0.5 : 1;
        f = Value(k * (1 + double(w.size()) / 1e3));
        computed_ = true;
      }
      folded.words.emplace_back(w, f);
    }
    TurnNumbers numbers;
    if (!machining_numbers(folded, s_.modes, numbers)) return no("its words are computed when the program runs"), false;
    cycles::TurnContext context;
    // A cycle that begins at a place of its own is told by the way there, wherever the tool stands.
    constexpr double far = std::numeric_limits<double>::quiet_NaN();
    const bool own = cycle.name == "stock.contour";
    context.start = own ? TurnPoint{far, far} : &out == &mine_ ? s_.at : at_;
    context.nose_width = s_.nose_width;
    context.longer_in_x = s_.longer_in_x;
    context.profile = profile_;
    context.left = &out.left;
    std::string error;
    auto moves = cycles::expand(*cycles::find_machining(cycle.name), numbers, context, &error);
    if (!moves) return no(error), false;
    out.moves = std::move(*moves);
    if (&out == &mine_) numbers_ = std::move(numbers);
    return true;
  }

  /// That the passes are counted with; a computed one is something usual, see play().
  [[nodiscard]] std::optional<double> depth_of_cut() const {
    const auto step = numbers_.find(mine_.left.face && numbers_.contains("axial_step") ? "axial_step" : "step");
    return step == numbers_.end() ? std::nullopt : std::optional(std::abs(step->second));
  }
  /// A blank that stands over the contour: the contour with a wall from its highest end out to there.
  std::optional<SimilarForm> with_tail(const NamedCycle& form) {
    const auto step = depth_of_cut();
    if (!mine_.left.finish.empty() || mine_.left.rough.empty() || !step ||
        (computed_ && s_.named.name != "stock.blank"))
      return std::nullopt;
    const auto height = [&](TurnPoint t) { return mine_.height(t); };
    cycles::TurnProfile longer = *s_.profile;
    const TurnPoint end = longer.part.back().to;
    for (const auto& e : longer.part) {
      if (height(e.from) > height(end) + same_place || height(e.to) > height(end) + same_place) return std::nullopt;
    }
    if (height(longer.part.front().from) > height(end) - same_place) return std::nullopt;
    const double top = mine_.first_pass() + *step;
    double to = top;
    Played theirs;
    for (int k = 0; k < 2; ++k) {
      TurnPoint tip = end;
      (mine_.left.face ? tip.z : tip.x) = mine_.left.out * to;
      if (height(tip) < height(end) + same_place) return std::nullopt;
      longer.part.resize(s_.profile->part.size());
      longer.part.push_back({end, tip, false, false, {}});
      theirs = {};
      profile_ = &longer;
      const bool played = play(form, theirs);
      profile_ = s_.profile;
      if (!played || theirs.left.rough.empty()) return std::nullopt;
      if (k == 0) to -= theirs.top() - top;
    }
    const auto& rough = theirs.left.rough;
    const auto& own = mine_.left.rough;
    if (rough.size() != own.size() + 1 || !same(std::vector(rough.begin(), rough.end() - 1), own)) return std::nullopt;
    const TurnPoint a = rough.back().from, b = rough.back().to;
    const bool straight = std::abs(mine_.left.face ? a.x - b.x : a.z - b.z) < same_place;
    if (!straight || theirs.left.face != mine_.left.face || theirs.left.out != mine_.left.out) return std::nullopt;
    if (recess() || mine_.first_pass() > theirs.top() + same_place) return std::nullopt;
    if (!cuts_as_much(theirs)) return std::nullopt;
    auto out = written(form, theirs);
    const double k = s_.modes.diameter == DiameterMode::radius || mine_.left.face ? 1 : 2;
    out.tail = std::round(mine_.left.out * to * k * 1e6) / 1e6;
    out.face = mine_.left.face;
    why_.clear();
    return out;
  }
  [[nodiscard]] bool recess() const {
    return std::any_of(mine_.left.rough.begin(), mine_.left.rough.end(),
                       [&](const ProfileElement& e) { return mine_.height(e.to) < mine_.height(e.from) - same_place; });
  }

  bool leaves_the_same(const Played& theirs) {
    if (theirs.left.face != mine_.left.face || theirs.left.out != mine_.left.out ||
        !same(theirs.left.rough, mine_.left.rough) || !same(theirs.left.finish, mine_.left.finish))
      return no("the target's cycle would come to another contour"), false;
    if (mine_.left.rough.empty()) return true;
    if (recess())
      return no("its contour has a recess, and the target's cycle leaves steps on the far side of one"), false;
    const double high = mine_.first_pass() - (from_the_tool_ ? theirs.height(at_) : theirs.top());
    // Any depth of cut takes less than the whole of a ring that stands over the contour.
    if (computed_ && s_.named.name == "stock.blank" && high + depth_of_cut().value_or(0) > same_place)
      return no("the blank stands over the highest point of the contour, and its depth of cut is computed"), false;
    if (high > same_place && !computed_)
      return no("the blank stands " + shortest(std::round(high * 1e3) / 1e3) +
                " mm and more over the highest point of the contour, where the target's cycle begins"),
             false;
    return cuts_as_much(theirs);
  }

  /// By the measure that the verifier takes; computed words are not what they will be.
  bool cuts_as_much(const Played& theirs) {
    if (computed_) return true;
    constexpr double room = 0.004;  // mm, of two contours
    cycles::TurnRole role{mine_.left.face, mine_.left.out, 1};
    const auto bound_of = [&] {
      cycles::RoleLine line;
      for (const auto& e : mine_.left.rough) {
        const auto part = e.arc ? cycles::role_arc(role, e.from, e.to, e.centre, e.ccw)
                                : cycles::RoleLine{role.of(e.from), role.of(e.to)};
        line.insert(line.end(), part.begin(), part.end());
      }
      return line;
    };
    role.come_from_the_low_end(bound_of());
    if (!from_the_tool_ && in_front(role, theirs)) return false;
    const auto fault =
        cycles::material_fault(bound_of(), by_role(role, mine_, s_.at), by_role(role, theirs, at_), room);
    if (!fault) return true;
    const double u = role.out * fault->at.p, v = role.back * fault->at.q;
    const double k = s_.modes.diameter == DiameterMode::radius ? 1 : 2;
    const auto shown = [](double n) { return shortest(std::round(n * 1e3) / 1e3 + 0.0); };
    return no(std::string(fault->in_rapid ? "the target's cycle would go through the blank in rapid, at X"
                                          : "the target's cycle would leave some of the blank, at X") +
              shown(k * (role.face ? v : u)) + " Z" + shown(role.face ? u : v)),
           false;
  }
  /// The target's cycle comes in rapid to 1 mm off the contour; the program says that its blank reaches further.
  bool in_front(const cycles::TurnRole& role, const Played& theirs) {
    if (theirs.moves.empty() || theirs.moves.front().step != TurnStep::rapid) return false;
    const double start = role.of(theirs.moves.front().to).q;
    double front = start;
    for (const auto& e : s_.profile->blank) front = std::max({front, role.of(e.from).q, role.of(e.to).q});
    if (front < start + 1e-3) return false;
    no("the blank reaches " + shortest(std::round((front - start) * 1e3) / 1e3) +
       " mm over the place that the target's cycle comes to in rapid");
    return true;
  }
  /// The moves from where the first one ends, or from the tool's place where that is known.
  static std::vector<cycles::RoleMove> by_role(const cycles::TurnRole& role, const Played& played, TurnPoint at) {
    std::vector<cycles::RoleMove> out;
    bool finishing = false;
    for (const auto& m : played.moves) {
      finishing = m.step == TurnStep::comp_left || m.step == TurnStep::comp_right ||
                  (finishing && m.step != TurnStep::comp_off);
      const bool arc = m.step == TurnStep::arc, cuts = arc || m.step == TurnStep::feed;
      if (!cuts && m.step != TurnStep::rapid) continue;
      if (!std::isnan(at.x) && !std::isnan(at.z))
        out.push_back({arc ? cycles::role_arc(role, at, m.to, m.centre, m.ccw) : cycles::role_straight(role, at, m.to),
                       cuts, finishing});
      at = m.to;
    }
    return out;
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
  /// From the place of the tool, with the profile's first point among the words.
  void profile_forms(std::vector<NamedCycle>& forms) {
    const bool by_blank = s_.named.name == "stock.blank";
    if (s_.named.name != "stock.contour" && !by_blank) return;
    NamedCycle f;
    f.name = mine_.left.face ? "face.profile" : "turn.profile";
    if (!s_.target.native_cycle(Cycle{f})) return;
    const auto variant = number("variant");
    if (!by_blank && (!variant || *variant >= 200)) {
      no("its passes leave steps");
      return;
    }
    if (mine_.left.rough.empty() || !s_.begins.x || !s_.begins.z) {
      no(mine_.left.rough.empty() ? "the target's cycle does not finish alone"
                                  : "its profile does not begin with a point in X and Z");
      return;
    }
    const auto put = [&](std::string_view name, const Value* v) {
      if (v != nullptr) f.words.emplace_back(std::string(name), plain(*v));
    };
    f.words.emplace_back("x", *s_.begins.x);
    f.words.emplace_back("z", *s_.begins.z);
    put("step", find_word(has("axial_step") ? "axial_step" : "step"));
    if (!is_zero("stock") && is_zero("stock_x") && is_zero("stock_z")) {
      put("stock_x", find_word("stock"));
    } else {
      const Value none(0.0);
      put("stock_x", has("stock_x") ? find_word("stock_x") : &none);
      put("stock_z", has("stock_z") ? find_word("stock_z") : &none);
    }
    if (!is_zero("groove_feed")) put("groove_feed", find_word("groove_feed"));
    if (!mine_.left.finish.empty()) put("finish_feed", find_word("finish_feed"));
    f.words.emplace_back("first_label", Value(1.0));
    f.words.emplace_back("last_label", Value(2.0));
    if (!by_blank && !s_.feed) {
      no("the feed in force before it is not known here");
      return;
    }
    if (!by_blank) at_ = mine_.moves.front().to;
    own_place_ = !by_blank;
    forms.push_back(std::move(f));
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
    const double k = s_.modes.diameter == DiameterMode::radius ? 1 : 2;
    if (own_place_) {
      const auto word = [](double v) { return Value(std::round(v * 1e6) / 1e6 + 0.0); };
      out.before = {word(at_.x * k), word(at_.z)};
    } else if (!from_the_tool_) {
      out.after = s_.start;
    }
    if (from_the_tool_ && !is_zero("rough_feed")) out.feed_before = plain(*find_word("rough_feed"));
    if (out.feed_before && s_.feed && equal(*out.feed_before, *s_.feed)) out.feed_before.reset();
    if (from_the_tool_ && (out.feed_before || !mine_.left.finish.empty())) out.feed = s_.feed;
    const auto* own = cycles::find_machining(s_.named.name);
    out.rapid_stays = own->ends_modes;
    if (own->ends_modes) out.feed = last_feed();
    const int a = mine_.passes(), b = theirs.passes();
    const auto one = [](int n) { return std::to_string(n) + (n == 1 ? " pass" : " passes"); };
    if (!computed_) out.differs = (a == b ? "as many passes" : one(b) + " instead of " + one(a)) + ", ";
    if (semi_finish_) out.differs += "each followed by its piece of the contour, not one pass along it at the end, ";
    const TurnPoint from = theirs.moves.empty() ? TurnPoint{} : theirs.moves.front().to;
    const auto shown = [](double v) { return shortest(std::round(v * 1e3) / 1e3 + 0.0); };
    if (from_the_tool_)
      out.differs += "from the place of the tool, not in equal steps";
    else if (!theirs.moves.empty() && theirs.moves.front().step == TurnStep::rapid)
      out.differs += "from X" + shown(from.x * k) + " Z" + shown(from.z) +
                     " (1 mm off the contour; nothing of the blank may stand there)";
    if (std::any_of(mine_.moves.begin(), mine_.moves.end(), [](const auto& m) { return m.sharp; }))
      out.differs += ", its finishing pass rounds the corners where the path is continuous (sharp in the source)";
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
  const cycles::TurnProfile* profile_ = s_.profile;
  TurnPoint at_ = s_.at;        ///< where the target's cycle is called
  bool from_the_tool_ = false;  ///< the passes of the target's cycle begin where the tool stands
  bool own_place_ = false;      ///< that is where the source's begins and ends by itself
  Played mine_;
  TurnNumbers numbers_;
  bool computed_ = false;
  bool semi_finish_ = false;  ///< a pass along the contour, with its allowances, before finishing
};

}  // namespace

std::optional<SimilarForm> similar_stock(const SimilarSource& source, std::string* why) {
  return StockForms(source, why).find();
}

}  // namespace cnctrans::ir::passes
