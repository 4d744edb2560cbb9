#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// An object of a class, as MATLAB 5 files have it, of which only these are known.
struct MatObject {
  std::string name;
  std::string class_name;
};

/// The variables of a MATLAB 5 file that are made of numbers, texts, cells and structures.
struct MatElements {
  std::string file;                   ///< a MATLAB 5 file of these alone, uncompressed
  std::vector<std::string> left_out;  ///< "NAME: a sparse matrix" and the like
  std::vector<MatObject> objects;
};

/// Takes a MATLAB 5 file apart ("MAT-File Format", The MathWorks, "Level 5 MAT-files"), expands
/// what is compressed, and checks that every array holds as many numbers as its dimensions say,
/// since the library trusts them. Throws InputError "is cut off" or "is damaged ...", not located;
/// bytes are those of a file with the text "MATLAB 5.0 MAT-file" at its beginning.
MatElements sound_elements(std::string_view bytes);

}  // namespace flexarm::measured
