#include "app/cli/demo_page.h"

#include "libprt/core/file.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

const char* const kHead = R"html(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>PRT Studio demo</title>
<style>
  :root { color-scheme: dark; }
  * { box-sizing: border-box; }
  body { margin: 0; background: #1e1e1e; color: #d6d6d6; font: 15px/1.5 system-ui, sans-serif; }
  main { max-width: 1120px; margin: 0 auto; padding: 40px 24px 64px; }
  h1 { font-size: 26px; font-weight: 600; margin: 0 0 4px; }
  p { color: #8c8c8c; margin: 0 0 28px; max-width: 60em; }
  section { display: grid; grid-template-columns: minmax(0, 2fr) minmax(220px, 1fr); gap: 24px; background: #262626;
            border: 1px solid #3a3a3a; border-radius: 6px; padding: 20px; margin-bottom: 24px; }
  h2 { font-size: 18px; font-weight: 600; margin: 0 0 4px; text-transform: capitalize; }
  img { width: 100%; display: block; border-radius: 4px; background: #161616; touch-action: none; cursor: ew-resize; user-select: none; }
  label { display: flex; align-items: center; gap: 12px; margin-top: 12px; color: #8c8c8c; font-size: 13px; }
  input { flex: 1; accent-color: #e0a341; }
  output { width: 4em; text-align: right; color: #d6d6d6; font-variant-numeric: tabular-nums; }
  dl { display: grid; grid-template-columns: auto 1fr; gap: 2px 16px; margin: 12px 0 0; font-size: 13px; }
  dt { color: #8c8c8c; }
  dd { margin: 0; text-align: right; font-variant-numeric: tabular-nums; }
  section p { margin: 0; font-size: 13px; }
  @media (max-width: 760px) { section { grid-template-columns: 1fr; } }
</style>
</head>
<body>
<main>
<h1>Light in motion, transport precomputed</h1>
<p>Each object was baked once. Every frame below is the same bake under a turned light: shadows, interreflections
and highlights follow without a ray being traced. Drag a picture or its slider.</p>
)html";

const char* const kTail = R"html(</main>
<script>
for (const section of document.querySelectorAll('section')) {
  const frames = JSON.parse(section.querySelector('script[type="application/json"]').textContent);
  const image = section.querySelector('img'), slider = section.querySelector('input'), angle = section.querySelector('output');
  const show = i => {
    const n = ((Math.round(i) % frames.length) + frames.length) % frames.length;
    slider.value = n;
    image.src = 'data:image/png;base64,' + frames[n];
    angle.textContent = Math.round(360 * n / frames.length) + '°';
  };
  slider.max = frames.length - 1;
  slider.addEventListener('input', () => show(Number(slider.value)));
  let from = null;
  image.addEventListener('dragstart', e => e.preventDefault());
  image.addEventListener('pointerdown', e => { from = { x: e.clientX, n: Number(slider.value) }; image.setPointerCapture(e.pointerId); });
  image.addEventListener('pointermove', e => { if (from) show(from.n + (e.clientX - from.x) / image.clientWidth * frames.length); });
  image.addEventListener('pointerup', () => { from = null; });
  show(0);
}
</script>
</body>
</html>
)html";

std::string readText(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = readFile(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string sectionOf(const DemoScene& scene) {
  std::string frames, facts;
  for (const auto& frame : scene.frames)
    frames += (frames.empty() ? "\"" : ",\"") + base64(readText(frame)) + "\"";
  for (const auto& [name, value] : scene.facts) facts += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
  return fmt::format(
      "<section>\n<div><img alt=\"{0}, relit\">\n<label>light <input type=\"range\" min=\"0\" "
      "value=\"0\"><output></output></label></div>\n"
      "<div><h2>{0}</h2><p>{1}</p>\n<dl>\n{2}</dl></div>\n<script "
      "type=\"application/json\">[{3}]</script>\n</section>\n",
      scene.name, scene.caption, facts, frames);
}

}  // namespace

std::string base64(const std::string& bytes) {
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? std::uint32_t((unsigned char)bytes[i + k]) : 0u;
    };
    const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (int k = 0; k < 4; ++k)
      out += i + std::size_t(k) <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string demoPage(const std::vector<DemoScene>& scenes) {
  std::string page = kHead;
  for (const DemoScene& scene : scenes) page += sectionOf(scene);
  return page + kTail;
}

}  // namespace prt::cli
