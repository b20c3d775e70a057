// SPDX-FileCopyrightText: Copyright (c) The Penumbra developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Messages between ranks as bytes. All ranks have the same byte order.
#ifndef penumbra_ByteStream_h
#define penumbra_ByteStream_h

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace penumbra
{

class ByteWriter
{
public:
  /// Adds values. A list of them that ByteReader is called with, too, is the format of a message.
  template <typename... Values>
  void operator()(const Values&... values)
  {
    (this->Add(values), ...);
  }

  template <typename T>
  void Add(const T& value)
  {
    static_assert(std::is_trivially_copyable<T>::value && !std::is_pointer<T>::value);
    this->AddBytes(&value, sizeof(T));
  }

  /// Adds the number of elements, then their bytes.
  template <typename T>
  void Add(const std::vector<T>& values)
  {
    this->Add(static_cast<std::uint64_t>(values.size()));
    this->AddBytes(values.data(), values.size() * sizeof(T));
  }

  void Add(const std::string& text)
  {
    this->Add(static_cast<std::uint64_t>(text.size()));
    this->Bytes += text;
  }

  std::string Take() { return std::move(this->Bytes); }

private:
  void AddBytes(const void* bytes, std::size_t size)
  {
    this->Bytes.append(static_cast<const char*>(bytes), size);
  }

  std::string Bytes;
};

/// Reads what a ByteWriter has written. `bytes` must outlive it.
class ByteReader
{
public:
  explicit ByteReader(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  bool IsAtEnd() const { return this->At == this->Bytes.size(); }

  template <typename... Values>
  void operator()(Values&... values)
  {
    (this->Get(values), ...);
  }

  template <typename T>
  void Get(T& value)
  {
    std::memcpy(static_cast<void*>(&value), this->Skip(sizeof(T)), sizeof(T));
  }

  template <typename T>
  T Get()
  {
    T value;
    this->Get(value);
    return value;
  }

  /// Appends the elements of an array to `values`.
  template <typename T>
  void Get(std::vector<T>& values)
  {
    const auto count = static_cast<std::size_t>(this->Get<std::uint64_t>());
    const std::size_t before = values.size();
    values.resize(before + count);
    if (count > 0)
    {
      std::memcpy(
        static_cast<void*>(&values[before]), this->Skip(count * sizeof(T)), count * sizeof(T));
    }
  }

  void Get(std::string& text)
  {
    const auto size = static_cast<std::size_t>(this->Get<std::uint64_t>());
    text.assign(this->Skip(size), size);
  }

private:
  const char* Skip(std::size_t size)
  {
    if (size > this->Bytes.size() - this->At)
    {
      throw std::runtime_error("A message of another rank is too short.");
    }
    const char* const from = this->Bytes.data() + this->At;
    this->At += size;
    return from;
  }

  const std::string& Bytes;
  std::size_t At = 0;
};

}
#endif
