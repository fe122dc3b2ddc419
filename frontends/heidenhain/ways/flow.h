// What the ways through a program bring to its items.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "frontends/heidenhain/state/flat.h"

namespace cnctrans::frontends::heidenhain {

class Flow {
 public:
  explicit Flow(const Flat& flat);

  /// All ways together.
  [[nodiscard]] const std::vector<Arrival>& arrivals() const { return arrivals_; }
  /// Index of the item of a label; -1: it is nowhere.
  [[nodiscard]] int label(const Item& use) const;
  /// What else comes behind a call than before it.
  struct Sets {
    bool tool = false, plunge = false, plane = false, pattern = false, cycle = false, texts = false;
    std::array<bool, along_text> text{};
    bool operator==(const Sets&) const = default;
  };
  /// The labels that are called as subprograms, in the order of the text, and what their ways reach.
  struct Root {
    int start = 0;              ///< item of the label; 0 of the main program
    std::vector<bool> reached;  ///< by item
    std::vector<int> ends;      ///< items of LBL 0 that end it
    bool runs_out = false;      ///< a way comes to the end of the text or of the program
    Sets sets;                  ///< what its ways set, with those of the subprograms that they call
  };
  /// [0]: the main program.
  [[nodiscard]] const std::vector<Root>& roots() const { return roots_; }
  /// Labels that stand twice: items of the second one.
  [[nodiscard]] const std::vector<int>& doubled() const { return doubled_; }

 private:
  [[nodiscard]] Arrival after(int item, Arrival a) const;
  [[nodiscard]] std::vector<int> next(int item, bool sub) const;
  void reach(Root& root, bool sub) const;
  void find_sets();
  [[nodiscard]] std::optional<std::size_t> root_of(const Item& call) const;
  static Arrival behind_call(const Arrival& before, Arrival out, const Sets& sets);
  void run();

  const Flat& flat_;
  std::map<std::string, int> labels_;
  std::vector<int> doubled_;
  std::vector<Root> roots_;
  std::vector<Arrival> arrivals_;
};

}  // namespace cnctrans::frontends::heidenhain
