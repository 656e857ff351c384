//! How large types and messages may be.

/// The longest text of an interface, in bytes.
pub const TEXT: usize = 1 << 20;

/// The most fields and constants that one interface has.
pub const MEMBERS: usize = 4096;

/// How deeply types are nested in each other.
pub const NESTING: usize = 32;

/// The most values that the fixed arrays of a type have together, nested ones included: a value of the type has all of them.
pub const FIXED_VALUES: usize = 1 << 22;

/// The most nested records and arrays of fixed length 0 that one message has: each takes far more memory than bytes of the message.
pub const RECORDS: usize = 1 << 20;

/// How deep folders with packages are searched.
pub const FOLDERS: usize = 4;
