#pragma once
// Files as the recipe tells them.

#include <QString>

namespace prt::ui {

class Document;

/// The path of a file from the project's folder, or from the root while the document has none.
QString toldPath(const Document& document, const QString& file);

}  // namespace prt::ui
