#include "base/nearest.h"

#include <gtest/gtest.h>

using namespace vsglbench;

TEST(Nearest, CountsSingleEdits) {
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("same", "same"), 0u);
}

TEST(Nearest, NamesTheClosestKnownName) {
  EXPECT_EQ(nearest_name("visibilty", {"scenes", "visibility", "seeds"}), "visibility");
  EXPECT_EQ(suggestion("visibilty", {"scenes", "visibility"}), "; did you mean 'visibility'?");
  EXPECT_EQ(suggestion("qqqqqqqq", {"scenes", "seeds"}), "; known: scenes, seeds");
}
