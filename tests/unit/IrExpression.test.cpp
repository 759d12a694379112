// Constructors, equality and negation; control flow; names of labels.
#include "ir/Evaluate.h"
#include "ir/Flow.h"
#include "tests/unit/IrHelper.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace dotek;
using namespace dotek::ir;
using namespace dotek::tests;

TEST_CASE("ir: equality is of trees, not of spelling") {
  const auto a = binary(BinaryOp::Add, variable(0), constant(5, {0, 1, 2}, "5."));
  CHECK(equal(a, binary(BinaryOp::Add, variable(0), constant(5))));
  CHECK_FALSE(equal(a, binary(BinaryOp::Add, variable(1), constant(5))));
  CHECK_FALSE(equal(a, binary(BinaryOp::Add, variable(0), constant(6))));
  CHECK_FALSE(equal(a, binary(BinaryOp::Subtract, variable(0), constant(5))));
  CHECK_FALSE(equal(a, variable(0)));
  CHECK(equal(nullValue(), nullValue()));
  CHECK(equal(machineVariable(constant(5)), machineVariable(constant(5))));
  CHECK_FALSE(equal(machineVariable(constant(5)), machineVariable(constant(6))));
  CHECK_FALSE(equal(result(ResultName::Main), result(ResultName::Size)));
  CHECK_FALSE(equal(unary(UnaryOp::Sine, variable(0)), unary(UnaryOp::Cosine, variable(0))));
  CHECK(equal(ExpressionPtr(), ExpressionPtr()));
  CHECK_FALSE(equal(a, ExpressionPtr()));

  const auto c = compare(Relation::Less, variable(0), constant(1));
  CHECK(equal(c, compare(Relation::Less, variable(0), constant(1), {0, 4, 5})));
  CHECK_FALSE(equal(c, compare(Relation::Greater, variable(0), constant(1))));
  CHECK(equal(join(Connective::And, c, truth(true)), join(Connective::And, c, truth(true))));
  CHECK_FALSE(equal(join(Connective::And, c, truth(true)), join(Connective::Or, c, truth(true))));
  CHECK_FALSE(equal(join(Connective::And, c, truth(true)), join(Connective::And, c, truth(false))));
  CHECK_FALSE(equal(isNull(variable(0)), isNull(variable(1))));
}

TEST_CASE("ir: a constant is never -0") {
  CHECK_FALSE(std::signbit(*constantValue(constant(-0.0))));
  CHECK(constantValue(variable(0)) == nullptr);
}

TEST_CASE("ir: a negation goes inward") {
  const auto less = compare(Relation::Less, variable(0), constant(1), {3, 4, 5});
  const auto null = isNull(variable(0));
  const auto negated = negate(join(Connective::And, less, null));
  const auto* junction = std::get_if<Junction>(&negated->node);
  REQUIRE(junction != nullptr);
  CHECK(junction->op == Connective::Or);
  CHECK(equal(junction->left, compare(Relation::GreaterEqual, variable(0), constant(1))));
  CHECK(junction->left->range == SourceRange{3, 4, 5});
  const auto* outside = std::get_if<Not>(&junction->right->node);
  REQUIRE(outside != nullptr);
  CHECK(equal(outside->inner, null));
  CHECK(equal(negate(negated), join(Connective::And, less, null)));
  CHECK(equal(negate(truth(true)), truth(false)));
}

TEST_CASE("ir: relations have opposites") {
  for (const Relation relation : {Relation::Equal, Relation::NotEqual, Relation::Less, Relation::Greater,
                                  Relation::LessEqual, Relation::GreaterEqual}) {
    CHECK(opposite(opposite(relation)) == relation);
    for (const double value : {-1.0, 0.0, 1.0}) {
      const auto with = [&](Relation it) { return holds(*compare(it, constant(value), constant(0)), {}); };
      CHECK(with(relation).value() != with(opposite(relation)).value());
    }
  }
}

TEST_CASE("ir: names of labels are unique") {
  Cycle cycle;
  cycle.labels.push_back({"next", {}}); // by hand
  CHECK(cycle.labels[cycle.addLabel({"next", {}})].name == "next_2");
  CHECK(cycle.labels[cycle.addLabel({"next_3", {}})].name == "next_3");
  CHECK(cycle.labels[cycle.addLabel({"next", {}})].name == "next_4");
  CHECK(cycle.labels[cycle.addLabel({"other", {}})].name == "other");
}

TEST_CASE("ir: flow") {
  const auto condition = compare(Relation::Less, variable(0), constant(1));
  const std::vector<CycleStatement> list = {
      statement(Branch{condition, 0}), // 0: to 1 or 3
      statement(Jump{1}),              // 1: to 5
      statement(Comment{"nobody"}),    // 2
      statement(Label{0}),             // 3
      statement(Alarm{"end"}),         // 4
      statement(Label{1}),             // 5
      statement(Return{}),             // 6
      statement(Jump{9}),              // 7: nowhere
  };
  using Places = std::vector<std::size_t>;
  const auto next = successors(list);
  REQUIRE(next.size() == list.size());
  CHECK(next[0] == Places{1, 3});
  CHECK(next[1] == Places{5});
  CHECK(next[2] == Places{3});
  CHECK(next[4].empty());
  CHECK(next[6] == Places{8});
  CHECK(next[7].empty());
  CHECK(reachable(list) == std::vector<bool>{true, true, false, true, true, true, true, false});
  CHECK(successors(std::vector{statement(Branch{condition, 0}), statement(Label{0})})[0] == Places{1});
  CHECK(reachable(std::vector<CycleStatement>{}).empty());
}

TEST_CASE("ir: flow of a program") {
  const auto condition = compare(Relation::Less, machineVariable(constant(1)), constant(1));
  std::vector<ProgramStatement> list = {
      {Label{0}, {}},                  // 0
      {Loop{1, condition, 1}, {}},     // 1: to 2 or 4
      {NcBlock{}, {}},                 // 2
      {LoopEnd{1, 0}, {}},             // 3: to 0
      {Label{1}, {}},                  // 4
      {JumpTo{constant(7)}, {}},       // 5: to any label
      {Exit{}, {}},                    // 6
      {Raise{constant(1), "end"}, {}}, // 7
  };
  ProgramFlow flow = flowOf(list);
  const auto& next = flow.next;
  CHECK(next[1] == Next{2, 4});
  CHECK(next[3] == Next{0});
  CHECK(next[5].empty());
  CHECK(isComputedJump(list[5]));
  CHECK(flow.labels == std::vector<std::size_t>{0, 4});
  CHECK(next[6] == Next{8});
  CHECK(next[7].empty());
  CHECK(reachable(list) == std::vector<bool>{true, true, true, true, true, true, false, false});
  list[5].blockDelete = 1;
  flow = flowOf(list);
  CHECK(next[5] == Next{6});
  CHECK(flow.labels == std::vector<std::size_t>{0, 4});
  CHECK(reachable(list)[6]);
}

TEST_CASE("ir: M30 and M2 end a program") {
  const auto code = [](double number) {
    NcBlock block;
    block.words.push_back({'M', constant(number), {}});
    return ProgramStatement{std::move(block), {}};
  };
  for (const double number : {30.0, 2.0}) {
    std::vector<ProgramStatement> list = {code(9), code(number), code(5)};
    CHECK(flowOf(list).next[0] == Next{1});
    CHECK(flowOf(list).next[1] == Next{3});
    CHECK(reachable(list) == std::vector<bool>{true, true, false});
    CHECK(endsProgram(list[1]));
    CHECK_FALSE(endsProgram(list[0]));
    // With the switch on, the control leaves the block out.
    list[1].blockDelete = 1;
    CHECK(flowOf(list).next[1] == Next{3, 2});
    CHECK(reachable(list)[2]);
  }
  // Which code this is turns out as it runs.
  NcBlock computed;
  computed.words.push_back({'M', machineVariable(constant(1)), {}});
  const ProgramStatement statement{std::move(computed), {}};
  CHECK(flowOf(std::vector{statement}).next[0] == Next{1});
}
