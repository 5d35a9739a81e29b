#include "energy/sources/model_spec.h"

#include "energy/sources/calibration.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <string>

namespace encore::energy {
namespace {

PowerModel constants(std::string_view text) {
  return std::get<PowerModel>(parse_model_spec(text));
}

std::string error_of(std::string_view text) {
  try {
    parse_model_spec(text);
  } catch (const PowerModelError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

TEST(ModelSpec, NamesWatts) {
  const PowerModel model = constants(" idle=12, render = 20 W,build=18.5W,gpu=30,uncertainty=10% ");
  EXPECT_EQ(model.idle, Watts(12));
  EXPECT_EQ(model.delta[Phase::render], Watts(20));
  EXPECT_EQ(model.delta[Phase::build], Watts(18.5));
  EXPECT_FALSE(model.delta[Phase::update]);
  EXPECT_EQ(model.gpu, Watts(30));
  EXPECT_EQ(model.uncertainty, 0.1);
  EXPECT_EQ(model.detail, "given by the user");
}

TEST(ModelSpec, BusyStandsForPhasesThatAreNotNamed) {
  const PowerModel model = constants("idle=12,busy=15,render=20");
  EXPECT_EQ(model.delta[Phase::animate], Watts(15));
  EXPECT_EQ(model.delta[Phase::transfer], Watts(15));
  EXPECT_EQ(model.delta[Phase::render], Watts(20));
  EXPECT_FALSE(model.gpu);
}

TEST(ModelSpec, MaxAsksForTheEstimateFromLoad) {
  const auto model = std::get<UtilisationModel>(parse_model_spec("idle=12,max=45"));
  EXPECT_EQ(model.idle, Watts(12));
  EXPECT_EQ(model.max, Watts(45));
}

TEST(ModelSpec, ThesisPresetHoldsTheReportedTotals) {
  const PowerModel model = constants("thesis-laptop");
  EXPECT_EQ(model, model_preset("thesis-laptop"));
  EXPECT_NEAR((model.idle + *model.delta[Phase::build]).value, 33.6, 1e-12);
  EXPECT_NEAR((model.idle + *model.delta[Phase::update]).value, 33.6, 1e-12);
  EXPECT_NEAR((model.idle + *model.delta[Phase::render]).value, 34.6, 1e-12);
  EXPECT_NEAR((model.idle + *model.gpu).value, 40.2, 1e-12);
  EXPECT_FALSE(model.delta[Phase::transfer]);  // the thesis could not tell it apart
}

TEST(ModelSpec, PresetsCanBeChanged) {
  const PowerModel model = constants("thesis-laptop,transfer=10,idle=20");
  EXPECT_EQ(model.delta[Phase::transfer], Watts(10));
  EXPECT_EQ(model.idle, Watts(20));
  EXPECT_TRUE(model.detail.ends_with("changed by the user"));
}

TEST(ModelSpec, EveryMistakeIsQuoted) {
  EXPECT_EQ(error_of(""), "power model: nothing is given; for example idle=12,render=20,build=18");
  EXPECT_EQ(error_of("render=20"),
            "power model: idle is missing: the watts that the machine draws while nothing runs, "
            "such as idle=12");
  EXPECT_EQ(error_of("idle=12,render=much"),
            "power model: render must be a number of watts from 0 to 100000, not 'much'");
  EXPECT_EQ(error_of("idle=12,render=-3"),
            "power model: render must be a number of watts from 0 to 100000, not '-3'");
  EXPECT_EQ(error_of("idle=nan,render=3"),
            "power model: idle must be a number of watts from 0 to 100000, not 'nan'");
  EXPECT_EQ(error_of("idle=12,idle=13,render=3"), "power model: idle is given twice");
  EXPECT_EQ(error_of("idle=12,redner=3"),
            "power model: unknown name 'redner'; known are idle, animate, build, update, transfer, "
            "render, busy, gpu, uncertainty, and max for an estimate from load");
  EXPECT_EQ(error_of("idle=12,,render=3"),
            "power model: '' is neither <name>=<watts> nor a preset (thesis-laptop) nor a .toml "
            "file; for example idle=12,render=20,build=18");
  EXPECT_EQ(error_of("thesis-desktop"),
            "power model: 'thesis-desktop' is neither <name>=<watts> nor a preset (thesis-laptop) "
            "nor a .toml file; for example idle=12,render=20,build=18");
  EXPECT_EQ(error_of("idle=12"),
            "power model: nothing is given above idle; add build=<watts>, render=<watts> or "
            "busy=<watts>");
  EXPECT_EQ(error_of("idle=12,max=45,build=3"),
            "power model: max asks for an estimate from load, which knows no build; leave one of "
            "the two out");
  EXPECT_EQ(error_of("idle=45,max=12"),
            "power model: idle must be below max, both from 0 to 100000 W; not idle=45, max=12");
  EXPECT_EQ(error_of("thesis-laptop,max=45"),
            "power model: max does not go with a preset; leave one out");
  EXPECT_EQ(error_of("idle=12,busy=3,uncertainty=150%"),
            "power model: uncertainty must be from 0% to 100%, such as 10%, not '150%'");
}

TEST(ModelSpec, UnknownPresetsAreRefusedByName) {
  try {
    model_preset("toaster");
    FAIL();
  } catch (const PowerModelError& error) {
    EXPECT_STREQ(error.what(),
                 "power model: no preset is called 'toaster'; there are: thesis-laptop");
  }
}

TEST(ModelSpec, NamesEndingInTomlAreCalibrationFiles) {
  const test::TemporaryFolder folder;
  const auto path =
      folder.write("my.toml", "format = 1\nidle_W = 7\n[above_idle]\nrender_W = 9.5\n");
  const PowerModel model = constants(path.string());
  EXPECT_EQ(model.idle, Watts(7));
  EXPECT_EQ(model.delta[Phase::render], Watts(9.5));
}

}  // namespace
}  // namespace encore::energy
