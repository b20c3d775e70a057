// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the numbers of Benchmarks/claims.txt, which stand on pages, with the rows of results that support them.
#include "SourceFiles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace penumbra_testing;

std::vector<std::string> Split(const std::string& text, const std::string& separator)
{
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + separator.size())
  {
    end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
  }
  return parts;
}

struct Claim
{
  std::string Page;
  std::string Text;
  std::string Table;
  std::vector<std::string> Rows;
};

std::vector<Claim> ReadClaims()
{
  std::vector<Claim> claims;
  for (const std::string& line : Split(Text(Root / "Benchmarks/claims.txt"), "\n"))
  {
    if (!line.empty() && line[0] != '#')
    {
      const std::vector<std::string> fields = Split(line, "\t");
      EXPECT_EQ(fields.size(), 4u) << line;
      if (fields.size() == 4)
      {
        claims.push_back({ fields[0], fields[1], fields[2], Split(fields[3], "; ") });
      }
    }
  }
  return claims;
}

struct Number
{
  double Value;
  int Decimals;
  bool IsPercentage;
};

/// Returns the numbers of a text; digits may be grouped by commas. Both numbers of "1 to 2 %" are percentages.
std::vector<Number> FindNumbers(const std::string& text)
{
  static const std::regex pattern(
    R"((-?(\d{1,3}(,\d{3})+|\d+)?(\.\d+)?(e[+-]?\d+)?)(\s*%|(?= to [\d.]+ %))?)");
  std::vector<Number> numbers;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
  {
    std::string digits = (*match)[1];
    digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
    if (digits.find_first_of("0123456789") != std::string::npos)
    {
      const auto decimals = static_cast<int>((*match)[4].length());
      numbers.push_back({ std::stod(digits), std::max(decimals - 1, 0), (*match)[6].matched });
    }
  }
  return numbers;
}

/// Returns the cells of the row of a table that begins with `key`, joined by ", ". Tables are Markdown or CSV.
std::string FindRow(const std::string& table, const std::string& key)
{
  static const std::regex bars(R"(\s+\|\s+)"), commas(",");
  for (const std::string& line : Split(table, "\n"))
  {
    const bool isMarkdown = line.rfind("| ", 0) == 0;
    const std::string cells =
      std::regex_replace(line.substr(isMarkdown ? 2 : 0), isMarkdown ? bars : commas, ", ") + ",";
    if (cells.rfind(key + ",", 0) == 0 || cells.rfind(key + ":", 0) == 0)
    {
      return cells;
    }
  }
  return "";
}

/// Returns the numbers of a row after its key; of "key // other key", the quotient of the first ones.
std::vector<Number> Measured(const Claim& claim, const std::string& row)
{
  std::vector<std::vector<Number>> numbers;
  for (const std::string& key : Split(row, " // "))
  {
    const std::string cells = FindRow(Text(Root / "Benchmarks/results" / claim.Table), key);
    EXPECT_FALSE(cells.empty()) << claim.Table << " has no row: " << key;
    numbers.push_back(FindNumbers(cells.substr(std::min(key.size(), cells.size()))));
  }
  if (numbers.size() == 2 && !numbers[0].empty() && !numbers[1].empty())
  {
    return { { numbers[0][0].Value / numbers[1][0].Value, 0, false } };
  }
  return numbers[0];
}

std::string JoinLines(const std::string& text)
{
  return std::regex_replace(text, std::regex("\\s+"), " ");
}

bool Supports(const std::vector<Number>& measured, const Number& claimed)
{
  const double unit = std::pow(10.0, -claimed.Decimals);
  return std::any_of(measured.begin(), measured.end(), [&](const Number& number) {
    return std::abs(number.Value - claimed.Value) <= 0.501 * unit ||
      (claimed.IsPercentage && std::abs(100.0 * number.Value - claimed.Value) <= 0.501 * unit);
  });
}

}

TEST(Claims, AreRowsOfResults)
{
  const std::vector<Claim> claims = ReadClaims();
  EXPECT_GT(claims.size(), 50u);
  for (const Claim& claim : claims)
  {
    EXPECT_NE(JoinLines(Text(Root / claim.Page)).find(claim.Text), std::string::npos)
      << claim.Page << " lacks: " << claim.Text;
    std::vector<Number> measured;
    for (const std::string& row : claim.Rows)
    {
      const std::vector<Number> numbers = Measured(claim, row);
      measured.insert(measured.end(), numbers.begin(), numbers.end());
    }
    for (const Number& number : FindNumbers(claim.Text))
    {
      EXPECT_TRUE(Supports(measured, number)) << claim.Page << ": " << claim.Text << ": no row of "
                                              << claim.Table << " has " << number.Value;
    }
  }
}

TEST(Results, AreLinkedFromPages)
{
  std::string pages;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(Root / "Documentation"))
  {
    pages += entry.path().extension() == ".md" ? Text(entry.path()) : "";
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(Root / "Benchmarks/results"))
  {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(
      entry.path().extension() != ".md" || pages.find("results/" + name) != std::string::npos)
      << name << " is linked from no page";
  }
}

TEST(Claims, RoundingDecides)
{
  const std::vector<Number> row = FindNumbers("0.987 | 18192 tiles | 1.35e-06");
  EXPECT_TRUE(Supports(row, FindNumbers("98.7 %")[0]));
  EXPECT_TRUE(Supports(row, FindNumbers("18,192")[0]));
  EXPECT_TRUE(Supports(row, FindNumbers("0.000001")[0]));
  EXPECT_TRUE(Supports(row, FindNumbers("98.7 to 99.0 %")[0]));
  EXPECT_FALSE(Supports(row, FindNumbers("98.6 %")[0]));
  EXPECT_FALSE(Supports(row, FindNumbers("0.000003")[0]));
}
