// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Inputs and answers of boxtree, a file a case: some in the repository, all of them beside it.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <connectivity/tree/box_tree.hpp>

#include <io/plain_hdf5.hpp>
#include <support/shared_data.hpp>

namespace connectivity::test {

/// The files found, by name without ".h5", ascending.
inline std::vector<std::filesystem::path> boxtree_files() {
    std::vector<std::filesystem::path> files;
    for (const std::string& folder :
         {shared_data("oracle/boxtree"),
          std::string(CONNECTIVITY_SOURCE_DIR "/tests/support/data/boxtree")}) {
        std::error_code absent;
        for (const auto& entry : std::filesystem::directory_iterator(folder, absent))
            if (entry.path().extension() == ".h5") files.push_back(entry.path());
        if (!files.empty()) break;
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// One case: what went in, and how to read what came out.
class BoxtreeCase {
public:
    explicit BoxtreeCase(const std::filesystem::path& path)
        : name_(path.stem().string()), file_(PlainFile::open(path.string())) {
        // That file has no parameters.
        params_ = name_ == "a3_linked"
                      ? nlohmann::json{{"d", 2}, {"leaf", 20}, {"sof", 0.25}, {"norm", "linf"}}
                      : nlohmann::json::parse(file_.strings("/", "params").at(0));
        read_input();
    }

    const std::string& name() const { return name_; }
    const nlohmann::json& params() const { return params_; }
    bool is_float32() const { return params_.value("f32", false); }
    const TreeInput& input() const { return input_; }
    const TreeOptions& options() const { return options_; }
    Offset n_sources() const { return input_.sources.n; }

    bool has(const std::string& key) const { return file_.has(key); }
    template <class T>
    std::vector<T> read(const std::string& key) const {
        return file_.read<T>(key);
    }
    const PlainFile& file() const { return file_; }

private:
    const void* array(const std::string& key) {
        if (!file_.has(key)) return nullptr;
        if (is_float32())
            return floats_
                .emplace_back(std::make_unique<std::vector<float>>(file_.read<float>(key)))
                ->data();
        return doubles_
            .emplace_back(std::make_unique<std::vector<double>>(file_.read<double>(key)))
            ->data();
    }
    ParticleArray particles(const std::string& kind) {
        const auto n = static_cast<Offset>(file_.extents("in_" + kind + "s")[0]);
        auto out = ParticleArray::interleaved(array("in_" + kind + "s"), n, input_.dim);
        out.radii = array("in_" + kind + "_radii");
        return out;
    }
    void read_input() {
        input_.dim = params_["d"].get<int>();
        input_.coordinates = is_float32() ? CoordinateType::float32 : CoordinateType::float64;
        input_.sources = particles("source");
        if (file_.has("in_targets")) input_.targets = particles("target");
        if (file_.has("in_refine_weights")) {
            weights_ = file_.read<int>("in_refine_weights");
            input_.refine_weights = weights_.data();
            options_.max_leaf_refine_weight = params_["maxw"].get<int>();
        } else {
            options_.max_particles_in_box = params_["leaf"].get<int>();
        }
        const auto kind = params_.value("kind", std::string("adaptive"));
        if (kind == "non-adaptive") options_.kind = TreeKind::non_adaptive;
        if (kind == "adaptive-level-restricted")
            options_.kind = TreeKind::adaptive_level_restricted;
        if (file_.has("in_source_radii") || file_.has("in_target_radii"))
            options_.stick_out_factor = params_.value("sof", 0.0);
        if (params_.value("norm", std::string("linf")) == "l2")
            options_.extent_norm = ExtentNorm::l2;
        options_.hulls = Hulls::always;
    }

    std::string name_;
    PlainFile file_;
    nlohmann::json params_;
    std::vector<std::unique_ptr<std::vector<double>>> doubles_;
    std::vector<std::unique_ptr<std::vector<float>>> floats_;
    std::vector<int> weights_;
    TreeInput input_;
    TreeOptions options_;
};

}  // namespace connectivity::test
