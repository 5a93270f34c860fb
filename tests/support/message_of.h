#pragma once
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <string>

namespace placegraph::test {

/// The message of the `Exception` that `function` throws; a test failure if it throws none.
template <class Exception = FileError, class Function>
std::string message_of(const Function& function) {
  try {
    function();
  } catch (const Exception& error) {
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another kind of exception: " << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace placegraph::test
