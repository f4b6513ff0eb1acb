#include "ui/model/told_path.h"

#include "ui/model/document.h"

#include <QFileInfo>

namespace prt::ui {

QString toldPath(const Document& document, const QString& file) {
  const std::filesystem::path absolute = QFileInfo(file).absoluteFilePath().toStdString();
  const std::filesystem::path relative = absolute.lexically_relative(document.folder());
  return QString::fromStdString((relative.empty() ? absolute : relative).generic_string());
}

}  // namespace prt::ui
