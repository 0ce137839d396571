# SPDX-License-Identifier: BSD-3-Clause
"""The part of the Fortran module that follows from the C headers alone: constants, structs, and an
interface of every function, in capi/fortran/c_<part>.inc.

Usage: bindings.py CAPI             compares the files with the headers, exit status 1 if not equal
       bindings.py CAPI --write     writes them
       bindings.py CAPI --test DIR  writes a program, DIR/offsets.{c,f90}, that compares the places
                                    of all members of all structs in the two languages

Pointers to one number or struct that is written are dummy arguments passed by reference, and so are
arrays of handles; all other pointers are type(c_ptr) by value, since they may be NULL.
"""
import pathlib
import re
import sys

PARTS = "base nodes map views fields traverse report boundary query tree lists gravity".split()
# C type: Fortran type, bytes, name of the kind
NUMBERS = {
    "int32_t": ("integer(c_int32_t)", 4, "c_int32_t"),
    "conn_status": ("integer(c_int32_t)", 4, "c_int32_t"),
    "int64_t": ("integer(c_int64_t)", 8, "c_int64_t"),
    "uint64_t": ("integer(c_int64_t)", 8, "c_int64_t"),
    "size_t": ("integer(c_size_t)", 8, "c_size_t"),
    "double": ("real(c_double)", 8, "c_double"),
}
CALLBACKS = ("conn_log_callback", "conn_pair_predicate", "conn_pair_function", "conn_rows_callback")
# Outputs that are one number; what else is not const is an array.
SCALARS = set(
    "n_threads n n_internal needed drift generation bytes high_water count n_offsets n_slots "
    "n_pairs n_components value n_failed length scratch_bytes total".split())
MAY_BE_NULL = {("conn_map_common_neighbours", "lists")}  # of the arrays of handles
RENAMED = {"H": "tensor"}  # Fortran does not tell h from H
ARRAY_DEFAULTS = {"ndim": "1", "stride": "1"}  # of conn_array, which has no macro


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


def members(body):
    """[(C type, is pointer, name, extent)] of a struct."""
    found = []
    for line in filter(None, (" ".join(part.split()) for part in body.split(";"))):
        kind, rest = re.fullmatch(r"(?:const )?(\w+(?: ?\*)?) ?(.*)", line).groups()
        for name in rest.split(","):
            name, extent = re.fullmatch(r"(\w+)(?:\[(\d)\])?", name.strip()).groups()
            found.append((kind.rstrip(" *"), kind.endswith("*"), name, int(extent or 1)))
    return found


def defaults(text, struct):
    """The values of the INIT macro of a struct, one for each member; {} if there is none."""
    macro = re.search(rf"#define {struct.upper()}_INIT((?:.*\\\n)*.*)", text)
    if not macro:
        return None
    body = macro.group(1).replace("\\\n", " ").strip()[1:-1]
    flat = re.sub(r"\{([^}]*)\}", lambda m: m.group(1).split(",")[0], body)
    return [value.strip() for value in flat.split(",")]


def value_of(text, kind):
    if kind != "c_double":
        return text
    return f"{text}_c_double" if re.search("[.e]", text) else f"{text}._c_double"


def struct_lines(text, name, body):
    size, lines, values = 0, [], defaults(text, name)
    fields = members(body)
    for index, (kind, pointer, field, extent) in enumerate(fields):
        fortran, bytes_, kind = ("type(c_ptr)", 8, None) if pointer else NUMBERS[kind]
        size = -(-size // bytes_) * bytes_ + bytes_ * extent
        value = values[index] if values else ARRAY_DEFAULTS.get(field, "0")
        value = "c_null_ptr" if pointer else value_of(value, kind)
        shape = f"({extent})" if extent > 1 else ""
        lines.append(f"        {fortran} :: {RENAMED.get(field, field)}{shape} = {value}")
    size = -(-size // 8) * 8
    if values:
        lines[0] = lines[0].split(" = ")[0] + f" = {size}"
    return [f"    type, bind(c), public :: {name}", *lines, f"    end type {name}", ""]


def argument(function, text, structs):
    """(name, declaration) of an argument."""
    text = " ".join(text.split())
    kind, name, extent = re.fullmatch(r"(.*?)(\w+)(\[\d\])?", text).groups()
    kind = kind.strip()
    name = RENAMED.get(name, name)
    base = kind.replace("const", "").replace("*", "").strip()
    if base in CALLBACKS:
        return name, f"type(c_funptr), value :: {name}"
    if kind.endswith("* const*") and (function, name) not in MAY_BE_NULL:
        return name, f"type(c_ptr), intent(in) :: {name}(*)"
    if "*" not in kind and not extent:
        return name, f"{NUMBERS[base][0]}, value :: {name}"
    if kind == f"{base}**" or kind in ("const char**", "double**"):
        return name, f"type(c_ptr), intent(inout) :: {name}"
    if "const" not in kind and base in structs:
        return name, f"type({base}), intent(inout) :: {name}"
    if "const" not in kind and base in NUMBERS and name in SCALARS:
        return name, f"{NUMBERS[base][0]}, intent(inout) :: {name}"
    return name, f"type(c_ptr), value :: {name}"


def wrapped(head, names, tail):
    """head(names) tail, in lines of at most 100 characters."""
    line, lines = head + "(", []
    pieces = [name + ", " for name in names[:-1]] + names[-1:]
    pieces[-1:] = [pieces[-1] + ") "] if names else [") "]
    for piece in pieces + tail:
        if len(line) + len(piece) > 97:
            lines.append(line + "&")
            line = " " * 12
        line += piece
    return lines + [line.rstrip()]


def function_lines(result, name, arguments, structs):
    split = [] if arguments.strip() == "void" else [
        argument(name, text, structs) for text in arguments.split(",")]
    short = name.replace("conn_", "c_", 1)
    bind = f"bind(c, name='{name}') "
    declarations = [f"            {text}" for _, text in split]
    names = [name for name, _ in split]
    if result == "void":
        head = wrapped(f"        subroutine {short}", names, [bind])
        return [*head, "            import", *declarations, f"        end subroutine {short}"]
    kind, out = ("type(c_ptr)", "text") if "*" in result else (NUMBERS[result][0], "answer")
    if result == "conn_status":
        out = "status"
    head = wrapped(f"        function {short}", names, [bind, f"result({out})"])
    return [*head, "            import", *declarations, f"            {kind} :: {out}",
            f"        end function {short}"]


def enumerators(text):
    for body in re.findall(r"\benum \{(.*?)\};", text, flags=re.S):
        yield from re.findall(r"(CONN_\w+) = (\d+)", body)


def part_text(capi, part, structs):
    header = f"connectivity_{part}.h"
    text = without_comments((capi / header).read_text())
    lines = ["! SPDX-License-Identifier: BSD-3-Clause",
             f"! Made from {header} by tests/fortran/bindings.py; the header says what they mean.",
             ""]
    constants = list(enumerators(text))
    if part == "base":
        numbers = dict(re.findall(r"#define (CONN_VERSION_(?:MAJOR|MINOR|PATCH)) (\d+)", text))
        constants = list(numbers.items()) + constants
    lines += [f"    integer(c_int32_t), parameter, public :: {name} = {value}"
              for name, value in constants]
    if constants:
        lines.append("")
    for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", text, flags=re.S):
        structs.add(name)
        lines += struct_lines(text, name, body)
    lines.append("    interface")
    functions = re.findall(r"CONN_API (\w+|const char\*) (conn_\w+)\((.*?)\);", text, flags=re.S)
    for result, name, arguments in functions:
        lines += function_lines(result, name, arguments, structs)
    return "\n".join(lines + ["    end interface", ""])


C_TEST = """#include <connectivity_boundary.h>
#include <connectivity_gravity.h>
#include <connectivity_lists.h>
#include <connectivity_query.h>
#include <connectivity_tree.h>
int64_t offset_in_c(int32_t k) {{
    static const size_t offsets[] = {{{offsets}}};
    return (int64_t)offsets[k];
}}
"""
FORTRAN_TEST = """program offsets
    use, intrinsic :: iso_c_binding
    use connectivity
    implicit none
    interface
        function offset_in_c(k) bind(c) result(offset)
            import
            integer(c_int32_t), value :: k
            integer(c_int64_t) :: offset
        end function offset_in_c
    end interface
    logical :: wrong = .false.
{variables}
{calls}
    if (wrong) error stop 1
contains
    subroutine compare(start, member, k, name)
        type(c_ptr), intent(in) :: start, member
        integer(c_int32_t), intent(in) :: k
        character(*), intent(in) :: name
        integer(c_intptr_t) :: offset
        offset = transfer(member, offset) - transfer(start, offset)
        if (offset == offset_in_c(k)) return
        wrong = .true.
        print '(a, 2(a, i0))', name, ' is at ', offset, ', in C at ', offset_in_c(k)
    end subroutine compare
end program offsets
"""


def write_test(capi, folder):
    offsets, variables, calls = [], [], []
    for part in PARTS:
        text = without_comments((capi / f"connectivity_{part}.h").read_text())
        for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", text, flags=re.S):
            variable = name.replace("conn_", "s_")
            variables.append(f"    type({name}), target :: {variable}")
            for _, _, field, _ in members(body):
                member = RENAMED.get(field, field)
                calls.append(f"    call compare(c_loc({variable}), c_loc({variable}%{member}), &\n"
                             f"                 {len(offsets)}, '{name}%{member}')")
                offsets.append(f"\n        offsetof({name}, {field})")
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "offsets.c").write_text(C_TEST.format(offsets=",".join(offsets)))
    (folder / "offsets.f90").write_text(
        FORTRAN_TEST.format(variables="\n".join(variables), calls="\n".join(calls)))


def main():
    capi = pathlib.Path(sys.argv[1])
    if "--test" in sys.argv:
        return write_test(capi, pathlib.Path(sys.argv[3]))
    structs, wrong = set(), 0
    for part in PARTS:
        path = capi / "fortran" / f"c_{part}.inc"
        text = part_text(capi, part, structs)
        if "--write" in sys.argv:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            print(f"{path} is not what connectivity_{part}.h says: bindings.py CAPI --write")
            wrong = 1
    return wrong


if __name__ == "__main__":
    sys.exit(main())
