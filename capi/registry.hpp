// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// All objects that C code holds pointers to: handles and the owners of views.
///
/// Invariants: a pointer is looked up before it is followed, so a dead or foreign one is an error
/// and no crash; the type of the object is its kind tag. When Kokkos stops, every object lets go of
/// its Views and lives on as a shell that can still be destroyed. Used under the call mutex only.

#include <memory>
#include <string>
#include <unordered_map>

#include <connectivity/base/error.hpp>

namespace connectivity::capi {

class Handle {
public:
    virtual ~Handle() = default;
    /// What it is, for messages: "a map".
    virtual const char* kind() const noexcept = 0;
    /// Frees all memory that Kokkos gave.
    virtual void drop_views() noexcept = 0;
};

class Registry {
public:
    static Registry& instance();

    /// Empties the objects when Kokkos stops and keeps the registry whole through a fork. Call
    /// after start_runtime.
    void watch_runtime();

    template <class T>
    T* add(std::unique_ptr<T> object) {
        T* const pointer = object.get();
        live_.emplace(pointer, std::move(object));
        return pointer;
    }

    /// The live object behind a pointer from C. Throws Error{null}, Error{handle}; `name` is the
    /// argument's.
    template <class T>
    T& get(const void* pointer, const std::string& name) const {
        if (pointer == nullptr) throw Error(Status::null, name + " is NULL");
        Handle* const object = find(pointer, name);
        if (auto* const typed = dynamic_cast<T*>(object)) return *typed;
        throw Error(Status::handle, name + " is " + object->kind());
    }

    /// Ends the object behind *pointer and sets it to NULL; nothing to do if pointer or *pointer is
    /// NULL.
    template <class T>
    void destroy(T** pointer, const std::string& name) {
        if (pointer == nullptr || *pointer == nullptr) return;
        remove(&get<T>(*pointer, name));
        *pointer = nullptr;
    }

private:
    Handle* find(const void* pointer, const std::string& name) const;
    void remove(const void* pointer);
    void drop_all() noexcept;

    std::unordered_map<const void*, std::unique_ptr<Handle>> live_;
    bool is_watching_ = false;
};

}  // namespace connectivity::capi
