// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Settings of a filter or pass that only experts change, and that no release promises to keep:
// constants of papers, and switches whose effect a benchmark measures. They are private members of
// the class, which lists them by name and range instead of declaring a setter for each. Use:
//
//   // Header: this pair instead of setters, and the members as before.
//   bool SetExpertSetting(const char* name, double value);
//   double GetExpertSetting(const char* name);
//   double Decay = 1.0;
//
//   // Source: the list, in the private implementation of the class or in a function of its own.
//   ExpertSettings experts;
//   experts.Add("Decay", this->Decay, 0.0, 1.0);
//
//   bool vtkMyPass::SetExpertSetting(const char* name, double value)
//   {
//     return this->Implementation->Experts.Set(this, name, value);
//   }
//
// PrintSelf() prints them by Print(). The page of the class lists them as not promised.
#ifndef penumbra_ExpertSettings_h
#define penumbra_ExpertSettings_h

#include "vtkIndent.h"
#include "vtkObject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace penumbra
{

class ExpertSettings
{
public:
  /// Lists a member of the object that owns this list. Values are clamped to the range.
  void Add(const char* name, double& member, double minimum, double maximum)
  {
    this->Settings.push_back({ name, &member, minimum, maximum });
  }
  void Add(const char* name, int& member, int minimum, int maximum)
  {
    this->Settings.push_back(
      { name, &member, static_cast<double>(minimum), static_cast<double>(maximum) });
  }
  void Add(const char* name, bool& member)
  {
    this->Settings.push_back({ name, &member, 0.0, 1.0 });
  }

  /// Sets a member and marks `owner` as modified if that changes its value; integers and flags are
  /// rounded. Returns false, with an error of `owner`, if the name is unknown or the value is NaN.
  bool Set(vtkObject* owner, const char* name, double value) const
  {
    const Setting* const setting = this->Find(owner, name);
    if (!setting || std::isnan(value))
    {
      if (setting)
      {
        vtkErrorWithObjectMacro(owner, << setting->Name << " must be a number, not NaN.");
      }
      return false;
    }
    const double clamped = std::clamp(value, setting->Minimum, setting->Maximum);
    const auto assign = [clamped](auto* member) {
      using Value = std::remove_reference_t<decltype(*member)>;
      const Value rounded = std::is_same_v<Value, double> ? static_cast<Value>(clamped)
                                                          : static_cast<Value>(std::round(clamped));
      return std::exchange(*member, rounded) != rounded;
    };
    if (std::visit(assign, setting->Member))
    {
      owner->Modified();
    }
    return true;
  }

  /// Returns the value of a setting, or NaN, with an error of `owner`, if the name is unknown.
  double Get(vtkObject* owner, const char* name) const
  {
    const Setting* const setting = this->Find(owner, name);
    return setting ? Read(*setting) : std::numeric_limits<double>::quiet_NaN();
  }

  /// Prints one line for each setting.
  void Print(std::ostream& os, vtkIndent indent) const
  {
    for (const Setting& setting : this->Settings)
    {
      os << indent << setting.Name << ": " << Read(setting) << "\n";
    }
  }

private:
  struct Setting
  {
    const char* Name;
    std::variant<double*, int*, bool*> Member;
    double Minimum;
    double Maximum;
  };

  static double Read(const Setting& setting)
  {
    return std::visit(
      [](const auto* member) { return static_cast<double>(*member); }, setting.Member);
  }

  const Setting* Find(vtkObject* owner, const char* name) const
  {
    std::string names;
    for (const Setting& setting : this->Settings)
    {
      if (name && setting.Name == std::string(name))
      {
        return &setting;
      }
      names += (names.empty() ? "" : ", ") + std::string(setting.Name);
    }
    vtkErrorWithObjectMacro(owner, << "There is no expert setting " << (name ? name : "(null)")
                                   << "; there are " << names << ".");
    return nullptr;
  }

  std::vector<Setting> Settings;
};

}
#endif
