//! The table of a property explorer.

/// A row.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Property {
    /// The name of the property.
    pub name: String,
    /// The name of its type.
    pub type_name: String,
    /// The value as text.
    pub value: String,
    /// Bits 0 and 1: it cannot be changed; -1: the title of a section; -3: a grey value.
    pub flags: i64,
    /// The name to show.
    pub displayed_name: String,
    /// The value to show.
    pub displayed_value: String,
    /// 1 for minus, 2 for plus.
    pub icon: i64,
    /// Explanation, e.g. for a tooltip.
    pub description: String,
}

/// Rows of names, types and values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Properties {
    /// The rows in order.
    pub rows: Vec<Property>,
    /// The selected row; -1 for none.
    pub selected: i64,
    /// Key and title of the entries of its menu.
    pub menu: Vec<[String; 2]>,
    /// Widths of the columns and the like, as scripts restore them.
    pub state: Vec<u8>,
}
