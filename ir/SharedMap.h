// A map from numbers to values whose copies share what is equal, so that facts before each statement of a
// long program cost what differs between them.
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

namespace dotek::ir {

// A binary trie over the bits of the keys, highest first (Okasaki and Gill, "Fast Mergeable Integer Maps",
// 1998). A change copies the path to the root. Values are copied and compared.
template <class Value> class SharedMap {
public:
  bool empty() const { return root_ == nullptr; }

  // The value at `key`; null: none. Lives as long as this map is not changed.
  const Value* find(std::uint32_t key) const {
    const Node* node = root_.get();
    while (node != nullptr && node->bit != 0) {
      if ((key & ~below(node->bit)) != node->key) return nullptr;
      node = (key & node->bit) == 0 ? node->low.get() : node->high.get();
    }
    return node != nullptr && node->key == key ? &node->value : nullptr;
  }

  // Puts `value` at `key`, whether there is one or not.
  void set(std::uint32_t key, Value value) { root_ = inserted(root_, leaf(key, std::move(value))); }

  void erase(std::uint32_t key) { root_ = without(root_, key); }

  // Takes over what `other` has. Where both have a key, `both(mine, its)` decides; of one value twice that is
  // the value. Whether anything changed.
  template <class Both> bool unite(const SharedMap& other, const Both& both) {
    return become(combined(root_, other.root_, both, Kept{}));
  }
  // As unite; a value that only one of the two has becomes `alone(key, value)`.
  template <class Both, class Alone>
  bool unite(const SharedMap& other, const Both& both, const Alone& alone) {
    return become(combined(root_, other.root_, both, alone));
  }
  // Puts `change(key, value)` at each key.
  template <class Change> void transform(const Change& change) { root_ = changedBy(root_, change); }
  // Keeps the keys that `other` has, with the value `both(mine, its)`, except where `gone(value)` says that
  // it is none. Whether anything changed.
  template <class Both, class Gone>
  bool intersect(const SharedMap& other, const Both& both, const Gone& gone) {
    return become(common(root_, other.root_, both, gone));
  }

  // In ascending order of the keys.
  template <class Visit> void each(const Visit& visit) const { eachIn(root_.get(), visit); }

private:
  struct Node;
  using Link = std::shared_ptr<const Node>;
  struct Node {
    std::uint32_t key = 0; // of a leaf; else what all keys below have above `bit`
    std::uint32_t bit = 0; // in which `low` and `high` differ; 0: a leaf
    Value value{};
    Link low, high;
  };

  // The bits up to `bit`, and it.
  static std::uint32_t below(std::uint32_t bit) { return bit | (bit - 1); }
  static bool covers(const Node& node, std::uint32_t key) { return (key & ~below(node.bit)) == node.key; }

  static Link leaf(std::uint32_t key, Value value) {
    return std::make_shared<const Node>(Node{key, 0, std::move(value), nullptr, nullptr});
  }
  static Link fork(std::uint32_t key, std::uint32_t bit, Link low, Link high) {
    if (!low) return high;
    if (!high) return low;
    return std::make_shared<const Node>(Node{key, bit, Value{}, std::move(low), std::move(high)});
  }
  // Two tries of which neither covers the other.
  static Link joined(const Link& a, const Link& b) {
    const std::uint32_t bit = std::bit_floor(a->key ^ b->key);
    const bool first = (a->key & bit) == 0;
    return fork(a->key & ~below(bit), bit, first ? a : b, first ? b : a);
  }

  struct Kept {}; // values that only one side has stay as they are

  template <class Alone> static Link alone(const Link& node, const Alone& change) {
    if constexpr (std::is_same_v<Alone, Kept>)
      return node;
    else
      return changedBy(node, change);
  }

  template <class Change> static Link changedBy(const Link& node, const Change& change) {
    if (!node) return node;
    if (node->bit != 0) return replaced(node, changedBy(node->low, change), changedBy(node->high, change));
    Value value = change(node->key, node->value);
    return value == node->value ? node : leaf(node->key, std::move(value));
  }

  template <class Both, class Alone>
  static Link combined(const Link& a, const Link& b, const Both& both, const Alone& lone) {
    if (!a) return alone(b, lone);
    if (!b) return alone(a, lone);
    if (a == b) return a;
    if (a->bit == 0 && b->bit == 0 && a->key == b->key) {
      Value value = both(a->value, b->value);
      if (value == a->value) return a;
      return value == b->value ? b : leaf(a->key, std::move(value));
    }
    if (a->bit == b->bit && a->bit != 0 && a->key == b->key)
      return replaced(a, combined(a->low, b->low, both, lone), combined(a->high, b->high, both, lone));
    if (a->bit > b->bit && covers(*a, b->key)) {
      const bool low = (b->key & a->bit) == 0;
      return replaced(a, combined(a->low, low ? b : nullptr, both, lone),
                      combined(a->high, low ? nullptr : b, both, lone));
    }
    if (b->bit > a->bit && covers(*b, a->key)) {
      const bool low = (a->key & b->bit) == 0;
      return replaced(b, combined(low ? a : nullptr, b->low, both, lone),
                      combined(low ? nullptr : a, b->high, both, lone));
    }
    return joined(alone(a, lone), alone(b, lone));
  }

  template <class Both, class Gone>
  static Link common(const Link& a, const Link& b, const Both& both, const Gone& gone) {
    if (!a || !b) return nullptr;
    if (a == b) return a;
    if (a->bit == 0 && b->bit == 0) {
      if (a->key != b->key) return nullptr;
      Value value = both(a->value, b->value);
      if (gone(value)) return nullptr;
      return value == a->value ? a : leaf(a->key, std::move(value));
    }
    if (a->bit == b->bit)
      return a->key == b->key
                 ? replaced(a, common(a->low, b->low, both, gone), common(a->high, b->high, both, gone))
                 : nullptr;
    if (a->bit > b->bit)
      return covers(*a, b->key) ? common((b->key & a->bit) == 0 ? a->low : a->high, b, both, gone) : nullptr;
    return covers(*b, a->key) ? common(a, (a->key & b->bit) == 0 ? b->low : b->high, both, gone) : nullptr;
  }

  static Link inserted(const Link& node, const Link& added) {
    if (!node || (node->bit == 0 && node->key == added->key)) return added;
    if (node->bit == 0 || !covers(*node, added->key)) return joined(node, added);
    return (added->key & node->bit) == 0 ? replaced(node, inserted(node->low, added), node->high)
                                         : replaced(node, node->low, inserted(node->high, added));
  }

  static Link without(const Link& node, std::uint32_t key) {
    if (!node) return nullptr;
    if (node->bit == 0) return node->key == key ? nullptr : node;
    if (!covers(*node, key)) return node;
    return (key & node->bit) == 0 ? replaced(node, without(node->low, key), node->high)
                                  : replaced(node, node->low, without(node->high, key));
  }

  // `node` with other children; itself where they are the same.
  static Link replaced(const Link& node, Link low, Link high) {
    if (low == node->low && high == node->high) return node;
    return fork(node->key, node->bit, std::move(low), std::move(high));
  }

  bool become(Link root) {
    const bool changed = root != root_;
    root_ = std::move(root);
    return changed;
  }

  template <class Visit> static void eachIn(const Node* node, const Visit& visit) {
    if (node == nullptr) return;
    if (node->bit == 0) {
      visit(node->key, node->value);
      return;
    }
    eachIn(node->low.get(), visit);
    eachIn(node->high.get(), visit);
  }

  Link root_;
};

} // namespace dotek::ir
