// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A JSON value that is read. Only Json.cxx includes the JSON library, which takes seconds to compile.
#ifndef penumbra_testing_Json_h
#define penumbra_testing_Json_h

#include <map>
#include <memory>
#include <string>

namespace penumbra_testing
{

/// A number, a text or an object; true is 1, false is 0 and null is NaN.
class Json
{
public:
  /// Throws std::exception for invalid text and for arrays.
  static Json Parse(const std::string& text);

  /// Returns a member of an object; throws std::out_of_range if it is missing.
  const Json& operator[](const std::string& name) const;
  std::size_t GetSize() const;

  operator double() const { return this->Number; }
  bool operator==(const std::string& text) const { return this->IsText && this->Text == text; }

private:
  friend class JsonReader;
  double Number = 0.0;
  bool IsText = false;
  std::string Text;
  std::map<std::string, std::shared_ptr<const Json>> Members;
};

}
#endif
