//! Encodings of mail, piece by piece: base64, quoted-printable, line lengths, line ends, leading dots.
//!
//! Text comes in chunks; what a chunk leaves undecided is handed to the next call. These are LuaSocket's low-level filters.

mod base64;
mod lines;
mod quoted_printable;

pub use base64::{decode_base64, encode_base64, finish_base64};
pub use lines::{stuff_dots, unify_line_ends, wrap_quoted_printable, wrap_text};
pub use quoted_printable::{QuotedPrintable, decode_quoted_printable};
