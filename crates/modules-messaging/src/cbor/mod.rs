//! The native part of the Lua modules `org.conman.cbor` and `org.conman.cbor_c`: CBOR between a Lua stack and bytes.
//!
//! Whole trees of plain values go through here at once. What needs Lua code - `__tocbor`, conversions, shared references - is left
//! to `lua/public/org/conman/cbor.lua`: these functions say so and have no effect then.

mod decode;
mod encode;
mod low_level;

use std::ffi::c_int;

use super::{ApiFn, Args, Module, Param, Result};
use script::needs_lua;

/// Nesting limit of arrays, maps and tags.
const MAX_DEPTH: usize = 500;
/// The text for what is nested deeper: a cycle most of the time.
const TOO_DEEP: &str = "nested too deeply (500 levels): does a table contain itself?";

type Call = fn(&mut Args<'_>) -> Result<c_int>;

const fn row(name: &'static str, doc: &'static str, params: &'static [Param], call: Call) -> ApiFn {
    ApiFn {
        name,
        doc,
        params,
        returns: &[],
        mutates: false,
        call,
        call_data: needs_lua,
    }
}

/// The module `org.conman.cbor`.
pub static CBOR: Module = Module {
    inner: &[TREES],
    ..Module::new("org.conman.cbor")
};
/// The module `org.conman.cbor_c`.
pub static CBOR_HEADS: Module = Module {
    about: "The heads of CBOR items: low-level functions of org.conman.cbor.",
    functions: &[("CBOR", HEADS)],
    ..Module::new("org.conman.cbor_c")
};
/// The module `simCBOR`.
pub static SIM_CBOR: Module = Module {
    inner: &[TREES],
    ..Module::new("simCBOR")
};

const TREES: &[ApiFn] = &[
    row(
        "org.conman.cbor.encode",
        "The value as CBOR; nothing when that needs Lua code; nil and a message when it cannot be.",
        &[Param::required("value", "any")],
        encode::encode,
    ),
    row(
        "org.conman.cbor.decode",
        "Type, next position and value; nothing when that needs Lua code; nil, a message and a position when the data are malformed. \
         Tags found in `tags` need Lua. With `rich`, byte strings become buffers and typed arrays tables.",
        &[
            Param::required("packet", "string"),
            Param::required("pos", "int"),
            Param::required("tags", "table"),
            Param::required("rich", "bool"),
        ],
        decode::decode,
    ),
    row(
        "org.conman.cbor.head",
        "What `org.conman.cbor_c.decode` tells, but nil and a message where there is no head.",
        &[
            Param::required("packet", "string"),
            Param::required("pos", "int"),
        ],
        low_level::head,
    ),
];

/// The functions of `org.conman.cbor_c`.
const HEADS: &[ApiFn] = &[
    row(
        "org.conman.cbor_c.encode",
        "A head of major type `type` with the number `n`, or of unknown length when `n` is nil. Type 0xE0 with a float `x`: that float, \
         in the precision `n` (25, 26, 27) or the shortest exact one.",
        &[
            Param::required("type", "int"),
            Param::required("n", "int"),
            Param::required("x", "float"),
        ],
        low_level::encode,
    ),
    row(
        "org.conman.cbor_c.decode",
        "Major type, info, number (the float of a float, infinity where the length is unknown) and next position of a head.",
        &[
            Param::required("packet", "string"),
            Param::required("pos", "int"),
        ],
        low_level::decode,
    ),
];
