#pragma once
// The figures that makeFigure() knows. Internal to study: to add one, declare it here and list it in
// figures.cpp.

#include "libprt/study/figures.h"

namespace prt {

nlohmann::json makeBiscaleAll(const FigureRequest& request, Job& job);
nlohmann::json makeBiscale1(const FigureRequest& request, Job& job);
nlohmann::json makeBiscale3(const FigureRequest& request, Job& job);
nlohmann::json makeBiscale4(const FigureRequest& request, Job& job);
nlohmann::json makeBiscale5(const FigureRequest& request, Job& job);
nlohmann::json makeBiscale6(const FigureRequest& request, Job& job);
nlohmann::json makeBiscaleTruth(const FigureRequest& request, Job& job);

}  // namespace prt
