#include "ui/model/command_index.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

QString s(const char* text) {
  return QString::fromUtf8(text);
}

TEST(FuzzyMatch, LettersInOrderInAnyCase) {
  EXPECT_TRUE(fuzzyMatch(s("frm"), s("Frame all")));
  EXPECT_TRUE(fuzzyMatch(s("FA"), s("Frame all")));
  EXPECT_FALSE(fuzzyMatch(s("mrf"), s("Frame all")));
  EXPECT_FALSE(fuzzyMatch(s("frames"), s("Frame all")));
  EXPECT_TRUE(fuzzyMatch(s(""), s("anything")));
}

TEST(FuzzyMatch, WordsMayComeInAnyOrder) {
  EXPECT_TRUE(fuzzyMatch(s("layout reset"), s("Reset window layout")));
  EXPECT_FALSE(fuzzyMatch(s("layout bake"), s("Reset window layout")));
}

TEST(FuzzyMatch, TellsWhichLettersMatched) {
  EXPECT_EQ(fuzzyMatch(s("rwl"), s("Reset window layout"))->positions, (std::vector<int>{0, 6, 13}))
      << "beginnings of words";
  EXPECT_EQ(fuzzyMatch(s("all"), s("Frame all"))->positions, (std::vector<int>{6, 7, 8}))
      << "side by side rather than scattered";
}

TEST(FuzzyMatch, NearerIsBetter) {
  const auto score = [](const char* query, const char* text) {
    return fuzzyMatch(s(query), s(text)).value().score;
  };
  EXPECT_GT(score("bak", "Bake"), score("bak", "Background"));
  EXPECT_GT(score("ray", "Rays"), score("ray", "Reset away"));
  EXPECT_GT(score("la", "Layout"), score("la", "Flat")) << "a word's beginning rather than its middle";
}

std::vector<Command> someCommands() {
  const auto command = [](const char* id, const char* title, const char* group) {
    return Command{.id = s(id),
                   .title = s(title),
                   .group = s(group),
                   .detail = {},
                   .shortcut = {},
                   .tip = {},
                   .run = {}};
  };
  return {
      command("menu/File/Open", "Open\u2026", "File"), command("menu/View/Frame all", "Frame all", "View"),
      command("row/transfer.bands", "Bands", "Transfer"), command("row/transfer.rays", "Rays", "Transfer"),
      command("menu/Samples/bird", "bird", "File \u203a Samples")};
}

QStringList titles(const std::vector<Command>& commands, const std::vector<RankedCommand>& ranked) {
  QStringList list;
  for (const RankedCommand& r : ranked) list << commands[std::size_t(r.index)].title;
  return list;
}

TEST(RankCommands, TheTitleCountsMoreThanTheGroup) {
  const std::vector<Command> all = someCommands();
  EXPECT_EQ(titles(all, rankCommands(all, s("bands"), {})), QStringList{s("Bands")});
  EXPECT_EQ(titles(all, rankCommands(all, s("tra"), {})), (QStringList{s("Bands"), s("Rays")}))
      << "found by where they are";
  EXPECT_EQ(titles(all, rankCommands(all, s("sample bird"), {})), QStringList{s("bird")});
  EXPECT_EQ(titles(all, rankCommands(all, s("nothing like it"), {})), QStringList());
}

TEST(RankCommands, WithoutAQueryTheRecentOnesLead) {
  const std::vector<Command> all = someCommands();
  EXPECT_EQ(titles(all, rankCommands(all, {}, {s("row/transfer.rays"), s("menu/View/Frame all")})).mid(0, 3),
            (QStringList{s("Rays"), s("Frame all"), s("Open\u2026")}));
  EXPECT_EQ(rankCommands(all, {}, {}).size(), all.size());
}

TEST(RankCommands, RecentUseDecidesBetweenNearlyEqual) {
  const std::vector<Command> all = someCommands();
  EXPECT_EQ(titles(all, rankCommands(all, s("tra"), {s("row/transfer.rays")})).first(), s("Rays"));
  EXPECT_EQ(titles(all, rankCommands(all, s("bands"), {s("row/transfer.rays")})).first(), s("Bands"))
      << "but not more than that";
}

}  // namespace
}  // namespace prt::ui
