// SPDX-License-Identifier: BSD-3-Clause
// What the library says about itself, and options of a context that this build does not have.

#include <cctype>
#include <map>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

/// JSON of objects, arrays, strings, whole numbers and literals; the text of each member of the
/// outermost object.
class Json {
public:
    explicit Json(std::string text) : text_(std::move(text)) {
        ok_ = value(0) && (skip(), at_ == text_.size());
    }
    bool ok() const { return ok_; }
    std::map<std::string, std::string> members;

private:
    void skip() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    }
    bool take(char c) {
        skip();
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }
    bool string() {
        if (!take('"')) return false;
        for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            if (static_cast<unsigned char>(text_[at_]) < 0x20) return false;
            if (text_[at_] == '\\') ++at_;
        }
        return take('"');
    }
    bool word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at_]))) ++at_;
        const std::string found = text_.substr(begin, at_ - begin);
        return found == "true" || found == "false" ||
               (!found.empty() && found.find_first_not_of("0123456789") == std::string::npos);
    }
    bool member(int depth) {
        skip();
        const std::size_t begin = at_;
        if (!string()) return false;
        const std::string name = text_.substr(begin + 1, at_ - begin - 2);
        if (!take(':')) return false;
        skip();
        const std::size_t first = at_;
        if (!value(depth + 1)) return false;
        if (depth == 0) members[name] = text_.substr(first, at_ - first);
        return true;
    }
    bool value(int depth) {
        skip();
        if (take('{')) {
            do {
                if (!member(depth)) return false;
            } while (take(','));
            return take('}');
        }
        if (take('[')) {
            do {
                if (!value(depth + 1)) return false;
            } while (take(','));
            return take(']');
        }
        return at_ < text_.size() && (text_[at_] == '"' ? string() : word());
    }

    std::string text_;
    std::size_t at_ = 0;
    bool ok_ = false;
};

TEST(CapiBuildInfo, is_one_json_object_with_the_documented_members) {
    Json info(conn_build_info());
    ASSERT_TRUE(info.ok()) << conn_build_info();
    EXPECT_EQ(info.members["version"], "\"" CONN_VERSION_STRING "\"");
    EXPECT_EQ(info.members["max_nodes"], "2147483647");
    EXPECT_NE(info.members["spaces"].find("\"host\""), std::string::npos);
    for (const char* flag : {"device", "asserts"})
        EXPECT_TRUE(info.members[flag] == "true" || info.members[flag] == "false") << flag;
    EXPECT_TRUE(info.members["kokkos_linkage"] == "\"private\"" ||
                info.members["kokkos_linkage"] == "\"shared\"");
    EXPECT_EQ(info.members["backends"].front(), '[');
    EXPECT_NE(info.members["kokkos"].find("Kokkos "), std::string::npos);
    EXPECT_GT(info.members["compiler"].size(), 2u);
}

TEST(CapiBuildInfo, every_backend_is_named_in_the_text_of_kokkos) {
    Json info(conn_build_info());
    ASSERT_TRUE(info.ok());
    const std::string& list = info.members["backends"];
    for (std::size_t at = list.find('"'), end; at < list.size(); at = list.find('"', end + 1)) {
        end = list.find('"', at + 1);
        const std::string name = list.substr(at + 1, end - at - 1);
        EXPECT_NE(info.members["kokkos"].find(" " + name), std::string::npos) << name;
    }
}

TEST(CapiContext, a_stream_is_refused_where_kernels_cannot_run_in_it) {
    int stream = 0;
    conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
    options.stream = &stream;
    conn_context* context = nullptr;
    EXPECT_TRUE(fails(conn_context_create(&options, &context), CONN_E_UNSUPPORTED,
                      {"options->stream", "NULL"}));
    EXPECT_EQ(context, nullptr);
    options.stream = nullptr;
    EXPECT_TRUE(ok(conn_context_create(&options, &context)));
    EXPECT_TRUE(ok(conn_context_destroy(&context)));
}

TEST(CapiContext, hosts_from_before_the_stream_are_served) {
    int garbage = 0;
    conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
    options.stream = &garbage;
    options.struct_size = offsetof(conn_context_options, stream);
    conn_context* context = nullptr;
    EXPECT_TRUE(ok(conn_context_create(&options, &context)));
    EXPECT_TRUE(ok(conn_context_destroy(&context)));
}

}  // namespace
}  // namespace connectivity::test
