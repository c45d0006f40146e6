#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Names the members that are state, in the visit of a class: `void visit(StateArchive& s) { STATE(s, count_,
/// last_); }`.
#define STATE(archive, ...) (archive)(#__VA_ARGS__, __VA_ARGS__)

namespace drycut {

/// Bytes that are no state of the object that is to take them.
class BadState : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A visitor of all that changes while a line runs. Each class of the loop says once, in its visit, which of
/// its members are state; parameters, wires and what follows from them are none. From that one visit come
/// bytes, the way back from bytes, and the list of members for "what differs first".
///
/// It takes numbers, enumerations, texts, the containers of the standard library, pointers to what is owned,
/// and whatever has `void visit(StateArchive&)` as a member or `void visit(StateArchive&, T&)` beside it.
/// Containers take the size of the state; what cannot be made anew, and what is owned, must be there already.
class StateArchive {
 public:
  using Bytes = std::vector<std::byte>;
  /// A member that is no group: where its bytes are.
  struct Member {
    std::string name;  ///< "knife.servo_.integral_"
    std::size_t offset;
    std::size_t size;
  };

  /// What logs have beside the states: the entries of each, once, in the order in which states were saved.
  struct Journal {
    Bytes bytes = {};                                     ///< not put away yet
    std::uint64_t begin = 0;                              ///< bytes before them
    std::uint64_t sum = first_sum;                        ///< over all entries
    std::map<std::uint64_t, std::uint64_t> written = {};  ///< entries of each log

    [[nodiscard]] std::uint64_t end() const { return begin + bytes.size(); }
  };
  static constexpr std::uint64_t first_sum = 14695981039346656037ULL;
  /// A sum over bytes that finds every change of one of them; over more of them from that over the first.
  static std::uint64_t sum_of(std::span<const std::byte> bytes, std::uint64_t before = first_sum) {
    // Another byte gives another sum, for each step can be undone. Eight bytes at a time, in four sums that
    // do not wait for one another.
    constexpr std::uint64_t prime = 1099511628211ULL;
    std::array<std::uint64_t, 4> sums{before, 1, 2, 3};
    for (; bytes.size() >= sizeof sums; bytes = bytes.subspan(sizeof sums)) {
      std::array<std::uint64_t, 4> words;
      std::memcpy(&words, bytes.data(), sizeof words);
      for (std::size_t n = 0; n < sums.size(); ++n) sums[n] = (sums[n] ^ words[n]) * prime;
    }
    std::uint64_t sum = sums[0];
    for (std::size_t n = 1; n < sums.size(); ++n) sum = (sum ^ sums[n]) * prime;
    for (const auto byte : bytes) sum = (sum ^ static_cast<std::uint64_t>(byte)) * prime;
    return sum;
  }

  /// Appends the state of `object`, which has a visit or is one, to `bytes`; tells the members to `list`, if
  /// there is one.
  template <class Object>
  static void save(Bytes& bytes, Object&& object, std::vector<Member>* list = nullptr,
                   Journal* journal = nullptr) {
    StateArchive state;
    state.out_ = &bytes;
    state.put_ = bytes.size();
    state.list_ = list;
    state.journal_ = journal;
    if constexpr (requires { object.visit(state); })
      object.visit(state);
    else
      object(state);
    bytes.resize(state.put_);
  }
  /// Sets what it visits from bytes of that order; throws BadState where they do not suffice. `skip`: this
  /// member stays as it is, by its number in the list, for tests.
  static StateArchive restoring(const std::byte* begin, std::size_t size,
                                std::optional<std::size_t> skip = {}) {
    StateArchive state;
    state.in_ = begin;
    state.end_ = begin + size;
    state.skip_ = skip.value_or(SIZE_MAX);
    return state;
  }
  /// The same with the entries of logs, from a journal up to where it was when the state was saved.
  static StateArchive restoring(std::span<const std::byte> bytes, std::span<const std::byte> journal) {
    auto state = restoring(bytes.data(), bytes.size());
    state.pieces_ = pieces_of(journal);
    return state;
  }
  /// A journal that goes on from there.
  static Journal going_on(std::span<const std::byte> journal) {
    Journal next;
    next.begin = journal.size();
    for (const auto& [piece, entries] : pieces_of(journal)) {
      next.written[piece.log] = piece.to;
      next.sum = piece.sum;
    }
    return next;
  }

  /// The members are being set: what follows from them is to be made anew.
  [[nodiscard]] bool restores() const { return out_ == nullptr; }
  /// Bytes that are left: 0 at the end of a whole state.
  [[nodiscard]] std::size_t left() const { return static_cast<std::size_t>(end_ - in_); }

  /// Visits `members`, whose names stand in `names` with commas between: see STATE.
  template <class... M>
  void operator()(std::string_view names, M&... members) {
    if (list_ == nullptr)
      (one(members), ...);
    else
      (named(next(names), members), ...);
  }
  /// Visits a member under a name that is made while it runs: a plant's, a device's.
  template <class M>
  void named(std::string_view name, M& member) {
    under(name, [&] { one(member); });
  }
  /// What `use` visits belongs to a group of that name.
  template <class Use>
  void under(std::string_view name, const Use& use) {
    if (list_ == nullptr) return use();
    const std::size_t before = path_.size();
    if (before > 0) path_ += '.';
    path_ += name;
    use();
    path_.resize(before);
  }
  /// Visits the elements of a list by `use`, which is given each, where a struct need not know that it is
  /// state. Of `each` there are as many as ever, a list takes the length of the state.
  template <class All, class Use>
  void each(std::string_view name, All& all, Use use) {
    auto size = static_cast<std::uint64_t>(all.size());
    named(name, size);
    if (size != all.size()) throw BadState("a list of another length: " + std::string(name));
    visit_each(name, all, use);
  }
  template <class All, class Use>
  void list(std::string_view name, All& all, Use use) {
    auto size = static_cast<std::uint64_t>(all.size());
    named(name, size);
    if (restores()) {
      if (size > left()) throw BadState("a list longer than the state");
      all.resize(static_cast<std::size_t>(size));
    }
    visit_each(name, all, use);
  }
  /// Visits a part that may not be there, of one who only looks on: its bytes are passed over then, and where
  /// the state has none it stays as it is.
  template <class Part>
  void part(std::string_view name, Part* part) {
    bool there = part != nullptr;
    named(name, there);
    if (!there) return;
    if (!restores()) {
      const auto place = put_;
      std::uint64_t size = 0;
      named(name, size);
      const auto begin = put_;
      named(name, *part);
      size = put_ - begin;
      std::memcpy(out_->data() + place, &size, sizeof size);
      return;
    }
    std::uint64_t size = 0;
    named(name, size);
    if (size > left()) throw BadState("it ends too early");
    if (part != nullptr)
      named(name, *part);
    else
      in_ += size;
  }
  /// Visits what only grows and may be large: rows, events, poses. The state has the number of its entries;
  /// the entries are in the journal, if there is one. A log has `std::size_t grown() const`, `void
  /// shorten(std::size_t)`, and `void entries(StateArchive&, std::size_t from, std::size_t to)`, which saves
  /// these entries or, from an archive that restores, appends them. Without a journal a log that is shorter
  /// than it was then stays as it is.
  template <class Log>
  void log(std::string_view name, Log& log) {
    auto size = static_cast<std::uint64_t>(log.grown());
    named(name, size);
    const auto number = sum_of(std::as_bytes(std::span(name)));
    if (restores()) return log_again(number, size, log);
    if (journal_ == nullptr) return;
    auto& from = journal_->written[number];
    if (from == size) return;
    Bytes entries;
    save(entries, [&](StateArchive& archive) {
      log.entries(archive, static_cast<std::size_t>(from), static_cast<std::size_t>(size));
    });
    journal_->sum = sum_of(entries, journal_->sum);
    const Piece piece = {number, from, size, entries.size(), journal_->sum};
    const auto head = std::as_bytes(std::span(&piece, 1));
    auto& bytes = journal_->bytes;
    bytes.insert(bytes.end(), head.begin(), head.end());
    bytes.insert(bytes.end(), entries.begin(), entries.end());
    from = size;
  }
  /// Visits the bytes of an object that is nothing but its bytes, as a generator of random numbers is.
  template <class T>
  void plain(std::string_view name, T& object) {
    static_assert(std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T>);
    StateBytes<sizeof(T)> bytes;
    std::memcpy(&bytes, &object, sizeof bytes);
    named(name, bytes);
    std::memcpy(static_cast<void*>(&object), &bytes, sizeof bytes);
  }
  /// One of `all` that `pointer` points to, or none: as its place in there.
  template <class T, class All>
  void pointer(std::string_view name, T*& pointer, const All& all) {
    std::int32_t place = -1;
    std::int32_t n = 0;
    for (const auto& object : all) {
      if (object == pointer) place = n;
      ++n;
    }
    named(name, place);
    if (!restores()) return;
    if (place >= n) throw BadState("a pointer to nothing");
    pointer = place < 0 ? nullptr : *std::next(std::begin(all), place);
  }

 private:
  /// Entries of a log in a journal: this, then their bytes.
  struct Piece {
    std::uint64_t log;
    std::uint64_t from;
    std::uint64_t to;
    std::uint64_t size;
    std::uint64_t sum;  // over them and all before
  };
  using Pieces = std::vector<std::pair<Piece, std::span<const std::byte>>>;

  StateArchive() = default;

  template <class All, class Use>
  void visit_each(std::string_view name, All& all, Use use) {
    std::size_t n = 0;
    for (auto& element : all) {
      if (list_ == nullptr) {
        use(element);
      } else {
        under(name, [&] { under(std::to_string(n++), [&] { use(element); }); });
      }
    }
  }

  static Pieces pieces_of(std::span<const std::byte> journal) {
    Pieces pieces;
    std::uint64_t sum = first_sum;
    while (!journal.empty()) {
      Piece piece{};
      if (journal.size() < sizeof piece) throw BadState("its journal ends too early");
      std::memcpy(&piece, journal.data(), sizeof piece);
      journal = journal.subspan(sizeof piece);
      if (journal.size() < piece.size) throw BadState("its journal ends too early");
      const auto entries = journal.first(static_cast<std::size_t>(piece.size));
      sum = sum_of(entries, sum);
      if (sum != piece.sum) throw BadState("its journal was changed");
      pieces.emplace_back(piece, entries);
      journal = journal.subspan(entries.size());
    }
    return pieces;
  }
  template <class Log>
  void log_again(std::uint64_t number, std::uint64_t size, Log& log) {
    if (!pieces_) {
      if (size <= log.grown()) log.shorten(static_cast<std::size_t>(size));
      return;
    }
    log.shorten(0);
    std::uint64_t reached = 0;
    for (const auto& [piece, entries] : *pieces_) {
      if (piece.log != number) continue;
      if (piece.from != reached) throw BadState("its journal has a gap");
      auto archive = restoring(entries.data(), entries.size());
      log.entries(archive, static_cast<std::size_t>(piece.from), static_cast<std::size_t>(piece.to));
      reached = piece.to;
    }
    if (reached != size) throw BadState("its journal is another state's");
  }

  static std::string_view next(std::string_view& names) {
    const std::size_t comma = names.find(',');
    const std::string_view name = names.substr(0, comma);
    names.remove_prefix(comma == std::string_view::npos ? names.size() : comma + 1);
    while (!names.empty() && names.front() == ' ') names.remove_prefix(1);
    return name;
  }

  // Thousands of small members: the bytes stand ready, none is made one by one.
  [[gnu::always_inline]] void raw(void* data, std::size_t size) {
    if (out_ != nullptr) {
      if (list_ != nullptr) list_->push_back({path_, put_, size});
      if (out_->size() - put_ < size) make_room(size);
      std::memcpy(out_->data() + put_, data, size);
      put_ += size;
      return;
    }
    if (left() < size) throw BadState("it ends too early");
    if (count_++ != skip_) std::memcpy(data, in_, size);
    in_ += size;
  }
  [[gnu::noinline]] void make_room(std::size_t size) {
    out_->resize(std::max(out_->capacity(), 2 * put_ + size));
  }
  /// Of what `count` elements of a container need at least a byte each.
  std::size_t sized(std::size_t now) {
    auto size = static_cast<std::uint64_t>(now);
    raw(&size, sizeof size);
    if (restores() && size > left()) throw BadState("a list longer than the state");
    return static_cast<std::size_t>(size);
  }
  void same(std::size_t now) {
    if (sized(now) != now) throw BadState("a list of another length");
  }

  template <std::size_t N>
  struct StateBytes {
    std::byte bytes[N];
  };
  template <std::size_t N>
  void one(StateBytes<N>& all) {
    raw(all.bytes, N);
  }
  template <class T>
  void one(T& member) {
    if constexpr (requires { member.visit(*this); }) {
      member.visit(*this);
    } else if constexpr (requires { T::visit(*this, member); }) {
      T::visit(*this, member);
    } else if constexpr (requires { visit(*this, member); }) {
      visit(*this, member);
    } else if constexpr (std::is_same_v<T, bool>) {
      auto byte = static_cast<std::uint8_t>(member);
      raw(&byte, 1);
      member = byte != 0;
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      raw(&member, sizeof member);
    } else {
      container(member);
    }
  }

  template <class T>
  void elements(T& all) {
    std::size_t n = 0;
    for (auto& element : all) {
      if (list_ == nullptr) {
        one(element);
      } else {
        named(std::to_string(n++), element);
      }
    }
  }

  void container(std::string& text) {
    const std::size_t size = sized(text.size());
    if (restores()) text.resize(size);
    if (size > 0) raw(text.data(), size);
  }
  void container(std::vector<bool>& all) {
    const std::size_t size = sized(all.size());
    if (restores()) all.resize(size);
    for (std::size_t n = 0; n < size; ++n) {
      bool on = all[n];
      one(on);
      all[n] = on;
    }
  }
  template <class T>
  void grown(T& all) {
    if constexpr (std::is_default_constructible_v<typename T::value_type>) {
      const std::size_t size = sized(all.size());
      if (restores()) all.resize(size);
    } else {
      same(all.size());
    }
    elements(all);
  }
  template <class T>
  void container(std::vector<T>& all) {
    if constexpr (std::is_arithmetic_v<T>) {
      const std::size_t size = sized(all.size());
      if (restores() && size > left() / sizeof(T)) throw BadState("a list longer than the state");
      if (restores()) all.resize(size);
      if (size > 0) raw(all.data(), size * sizeof(T));
    } else {
      grown(all);
    }
  }
  template <class T>
  void container(std::deque<T>& all) {
    grown(all);
  }
  template <class T, std::size_t N>
  void container(std::array<T, N>& all) {
    if constexpr (std::is_arithmetic_v<T> && N > 0) {
      raw(all.data(), sizeof all);
    } else {
      elements(all);
    }
  }
  template <class T, std::size_t N>
  void container(T (&all)[N]) {
    elements(all);
  }
  template <class A, class B>
  void container(std::pair<A, B>& both) {
    (*this)("first, second", both.first, both.second);
  }
  template <class T>
  void container(std::optional<T>& member) {
    bool there = member.has_value();
    one(there);
    if (restores() && there != member.has_value()) {
      if (there) {
        member.emplace();
      } else {
        member.reset();
      }
    }
    if (member) one(*member);
  }
  /// What is owned is there or not from the beginning: no part of the state.
  template <class T>
  void container(std::unique_ptr<T>& member) {
    same(member ? 1 : 0);
    if (member) one(*member);
  }
  template <class K, class V, class C>
  void container(std::map<K, V, C>& all) {
    const std::size_t size = sized(all.size());
    if (!restores()) {
      for (auto& [key, value] : all) {
        K copy = key;
        one(copy);
        one(value);
      }
      return;
    }
    all.clear();
    for (std::size_t n = 0; n < size; ++n) {
      K key{};
      one(key);
      one(all[key]);
    }
  }
  template <class T, class C>
  void container(std::set<T, C>& all) {
    std::vector<T> list(all.begin(), all.end());
    container(list);
    if (restores()) all = std::set<T, C>(list.begin(), list.end());
  }
  template <class... T>
  void container(std::variant<T...>& member) {
    auto index = static_cast<std::uint8_t>(member.index());
    raw(&index, 1);
    if (restores() && index != member.index()) {
      if (index >= sizeof...(T)) throw BadState("a variant that there is not");
      std::size_t n = 0;
      ((n++ == index ? static_cast<void>(member.template emplace<T>()) : static_cast<void>(0)), ...);
    }
    std::visit([this](auto& value) { this->one(value); }, member);
  }
  void container(std::monostate&) {}

  Bytes* out_ = nullptr;
  std::size_t put_ = 0;  // so many of its bytes are the state's
  std::vector<Member>* list_ = nullptr;
  Journal* journal_ = nullptr;
  std::optional<Pieces> pieces_;
  std::string path_;
  const std::byte* in_ = nullptr;
  const std::byte* end_ = nullptr;
  std::size_t count_ = 0;
  std::size_t skip_ = SIZE_MAX;
};

}  // namespace drycut
