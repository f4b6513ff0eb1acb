#include "libprt/atlas/chart_settings.h"

#include "libprt/core/error.h"
#include "libprt/mesh/generate.h"
#include "tests/atlas/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace prt {
namespace {

/// A plane of 8 x 8 squares cut in two along its middle row of vertices.
struct CutPlane {
  CutPlane() : surface(makePlane({.columns = 8, .rows = 8}), job), seams(surface) {
    std::vector<std::uint32_t> row;
    for (std::uint32_t v = 0; v < surface.vertexCount(); ++v)
      if (std::abs(surface.positions[v].x) < 1e-6f) row.push_back(v);
    std::sort(row.begin(), row.end(), [&](std::uint32_t a, std::uint32_t b) {
      return surface.positions[a].z < surface.positions[b].z;
    });
    cutPath(surface, row, seams);
  }
  Job job;
  Surface surface;
  Seams seams;
};

TEST(ChartSettings, TextsRoundTrip) {
  const std::string text =
      "12 weight=2 corners=5;40 corners=0,0.25,0.7 place=0.5,0.25,30,0.2 locked;41 weight=0.5";
  const std::vector<ChartSettings> settings = chartSettingsFromText(text);
  ASSERT_EQ(settings.size(), 3u);
  EXPECT_EQ(settings[0].weight, 2);
  EXPECT_EQ(settings[0].cornerCount, 5);
  EXPECT_EQ(settings[1].corners, (std::vector<double>{0, 0.25, 0.7}));
  EXPECT_NEAR(settings[1].place->angle, kPi / 6, 1e-12);
  EXPECT_TRUE(settings[1].locked);
  EXPECT_EQ(chartSettingsToText(settings), text);
  EXPECT_TRUE(chartSettingsFromText("").empty());
  EXPECT_EQ(chartSettingsToText(chartSettingsFromText("7;9 weight=3")), "9 weight=3");
}

TEST(ChartSettings, WhatIsNoSettingIsQuoted) {
  for (const char* wrong : {"x", "1 weight=0", "1 weight=nan", "1 corners=2", "1 corners=0,0.5",
                            "1 corners=0,0.5,0.4", "1 corners=0,0.5,1", "1 place=1,2,3", "1 place=0,0,0,0",
                            "1 lock", "-1", "4294967295 weight=2", "1 corners=3.5"}) {
    try {
      chartSettingsFromText(wrong);
      ADD_FAILURE() << wrong;
    } catch (const ValueError& error) {
      EXPECT_NE(error.problem().find('\''), std::string::npos);
    }
  }
}

TEST(ChartSettings, StayWithTheirChartWhenAnotherIsCut) {
  CutPlane plane;
  const Charts two = makeCharts(plane.surface, plane.seams, plane.job);
  ASSERT_EQ(two.charts.size(), 2u);
  ChartSettings second;
  second.face = two.charts[1].faces.front();
  second.weight = 4;
  // The first chart falls into two; the second is another number then.
  const std::uint32_t face = two.charts[0].faces.front();
  for (const std::uint32_t half : {3 * face, 3 * face + 1, 3 * face + 2})
    plane.seams.set(plane.surface.edge[half]);
  const Charts more = makeCharts(plane.surface, plane.seams, plane.job);
  ASSERT_GT(more.charts.size(), 2u);
  const std::vector<ChartSettings> own = settingsOfCharts(more, std::vector{second});
  for (std::size_t c = 0; c < own.size(); ++c) {
    const auto& faces = more.charts[c].faces;
    const bool has = std::find(faces.begin(), faces.end(), second.face) != faces.end();
    EXPECT_EQ(own[c].weight, has ? 4 : 1);
    EXPECT_EQ(more.chartOf[own[c].face], c);
  }
}

TEST(ChartSettings, CornersLieWhereTheyWereAskedFor) {
  const std::vector<double> lengths{1, 1, 2, 2, 1, 1};  // 8 round
  EXPECT_EQ(cornersAt(lengths, std::vector<double>{0, 0.26, 0.76}), (std::vector<std::uint32_t>{0, 2, 4}));
  EXPECT_EQ(cornersAt(lengths, std::vector<double>{0.97}), (std::vector<std::uint32_t>{0}))
      << "nearest round the end";
  const std::vector<std::uint32_t> corners{1, 3, 5};
  EXPECT_EQ(cornersAt(lengths, placesOf(lengths, corners)), corners);

  CutPlane plane;
  const Charts two = makeCharts(plane.surface, plane.seams, plane.job);
  ChartSettings first;
  first.face = two.charts[0].faces.front();
  first.cornerCount = 3;
  const FlatCharts flat = flattenCharts(plane.surface, plane.seams, {}, std::vector{first}, plane.job);
  // The one on a triangle is stretched, the free one is as flat as it was.
  EXPECT_GT(flat.stretch[0].l2(), 1.02);
  EXPECT_NEAR(flat.stretch[1].l2(), 1, 1e-3);
}

TEST(ChartSettings, PlacesThatOverlapOrLeaveTheSquareAreTold) {
  const std::vector<DVec2> square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  const std::vector<std::vector<DVec2>> outlines{square, square, square};
  const auto at = [](double u, double v) { return ChartPlacement{0.1, 0, {u, v}, true}; };
  EXPECT_TRUE(placementProblems(outlines, std::vector{at(0.1, 0.1), at(0.3, 0.1), at(0.9, 0.9)}, 256).empty())
      << "touching is not overlapping";
  const auto problems =
      placementProblems(outlines, std::vector{at(0.1, 0.1), at(0.25, 0.2), at(0.95, 0.5)}, 256);
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0].chart, 0u);
  EXPECT_EQ(problems[0].other, 1u);
  EXPECT_EQ(problems[1].chart, 2u);
  EXPECT_EQ(problems[1].other, 2u);
}

}  // namespace
}  // namespace prt
