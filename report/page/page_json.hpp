#pragma once

#include "report/page/page_document.hpp"

#include <cstddef>
#include <string>

namespace flexarm::report::page {

/// The texts of the page's two elements.
struct PageTexts {
  std::string document;  ///< JSON, without "<"
  std::string arrays;    ///< base64
};

/// A document by the contract. The document must have unique ids.
///
/// Records share what other arrays leave of `most_array_bytes`, at least an eighth of it: short
/// ones are in the page whole, as f32; what a long one has beyond its share is left to an envelope.
/// Throws std::invalid_argument for curves whose vectors have unlike lengths, and for a view
/// without one label for each choice.
PageTexts page_texts(const PageDocument& document,
                     std::size_t most_array_bytes = 6'500'000);  // 8.7 MB as base64

}  // namespace flexarm::report::page
