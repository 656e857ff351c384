//! Tables of cells. Only cells with something in them take memory: a script may ask for any number of rows.

use std::collections::BTreeMap;

use super::picture::Image;

/// What a click selects.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SelectionMode {
    /// A single cell.
    #[default]
    Item,
    /// A whole row.
    Row,
    /// A whole column.
    Column,
}

impl SelectionMode {
    pub(crate) const NAMES: [&'static str; 3] = ["item", "row", "column"];

    pub(crate) fn named(name: &str) -> Self {
        match name {
            "row" => Self::Row,
            "column" => Self::Column,
            _ => Self::Item,
        }
    }

    pub(crate) fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }
}

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The text in it.
    pub text: String,
    /// Whether a person can change it, in a table that can be edited.
    pub editable: bool,
    /// The picture in it.
    pub image: Option<Image>,
}

impl Cell {
    /// An editable cell with a text.
    pub fn of_text(text: String) -> Self {
        Self {
            text,
            editable: true,
            image: None,
        }
    }
}

/// Texts of headers by row or column.
pub(crate) type HeaderTexts = BTreeMap<i64, String>;

/// The smallest and largest size of rows or columns, pixels.
pub(crate) type Sizes = Option<[i64; 2]>;

/// A table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Number of rows.
    pub row_count: i64,
    /// Number of columns.
    pub column_count: i64,
    /// The cells with content, by row and column.
    pub cells: BTreeMap<(i64, i64), Cell>,
    /// Titles of rows by their index.
    pub row_headers: HeaderTexts,
    /// Titles of columns by their index.
    pub column_headers: HeaderTexts,
    /// Smallest and largest height of rows, pixels; None for the default.
    pub row_height: Sizes,
    /// Smallest and largest width of columns, pixels; None for the default.
    pub column_width: Sizes,
    /// Whether the horizontal and the vertical header are shown.
    pub(crate) show_header: [bool; 2],
    pub(crate) autosize_header: [bool; 2],
    pub(crate) show_grid: bool,
    /// Whether a person can change cells.
    pub editable: bool,
    pub(crate) sortable: bool,
    pub(crate) selection_mode: SelectionMode,
    /// Row and column; -1 where the mode has none, or nothing is selected.
    pub selection: [i64; 2],
}

impl Table {
    /// Whether there is a cell in that row and column, from 0.
    pub fn contains(&self, row: i64, column: i64) -> bool {
        (0..self.row_count).contains(&row) && (0..self.column_count).contains(&column)
    }

    /// The text of a cell; empty where there is none.
    pub fn text(&self, row: i64, column: i64) -> &str {
        self.cells
            .get(&(row, column))
            .map_or("", |cell| cell.text.as_str())
    }

    /// Sets the text of a cell; whether it was another one. Nothing happens outside of the table.
    pub(crate) fn set_text(&mut self, row: i64, column: i64, text: String) -> bool {
        if !self.contains(row, column) {
            return false;
        }
        let cell = self
            .cells
            .entry((row, column))
            .or_insert_with(|| Cell::of_text(String::new()));
        let differs = cell.text != text;
        cell.text = text;
        differs
    }

    /// Removes cells and headers; the size stays.
    pub fn clear(&mut self) {
        self.cells.clear();
        self.row_headers.clear();
        self.column_headers.clear();
        self.selection = [-1; 2];
    }

    /// Sets the number of rows and columns; cells outside of them are removed.
    pub fn resize(&mut self, rows: i64, columns: i64) {
        (self.row_count, self.column_count) = (rows.max(0), columns.max(0));
        let (rows, columns) = (self.row_count, self.column_count);
        self.cells
            .retain(|(row, column), _| *row < rows && *column < columns);
        self.row_headers.retain(|row, _| *row < rows);
        self.column_headers.retain(|column, _| *column < columns);
        if self.selection[0] >= rows || self.selection[1] >= columns {
            self.selection = [-1; 2];
        }
    }

    /// Opens a row, which keeps the text of the one it moves down. Nothing happens outside of the table.
    pub fn insert_row(&mut self, at: i64) {
        if !(0..=self.row_count).contains(&at) {
            return;
        }
        self.row_count = self.row_count.saturating_add(1);
        self.remap(|(row, column)| {
            if row >= at {
                (row + 1, column)
            } else {
                (row, column)
            }
        });
        self.copy(|(row, column)| (row == at + 1).then_some((at, column)));
    }

    /// Inserts a column, which keeps the text of the one it moves to the right. Nothing happens outside of the table.
    pub fn insert_column(&mut self, at: i64) {
        if !(0..=self.column_count).contains(&at) {
            return;
        }
        self.column_count = self.column_count.saturating_add(1);
        self.remap(|(row, column)| {
            if column >= at {
                (row, column + 1)
            } else {
                (row, column)
            }
        });
        self.copy(|(row, column)| (column == at + 1).then_some((row, at)));
    }

    /// Removes a row. Nothing happens outside of the table.
    pub fn remove_row(&mut self, at: i64) {
        if !(0..self.row_count).contains(&at) {
            return;
        }
        self.cells.retain(|(row, _), _| *row != at);
        self.remap(|(row, column)| {
            if row > at {
                (row - 1, column)
            } else {
                (row, column)
            }
        });
        self.resize(self.row_count - 1, self.column_count);
    }

    /// Removes a column. Nothing happens outside of the table.
    pub fn remove_column(&mut self, at: i64) {
        if !(0..self.column_count).contains(&at) {
            return;
        }
        self.cells.retain(|(_, column), _| *column != at);
        self.remap(|(row, column)| {
            if column > at {
                (row, column - 1)
            } else {
                (row, column)
            }
        });
        self.resize(self.row_count, self.column_count - 1);
    }

    fn remap(&mut self, place: impl Fn((i64, i64)) -> (i64, i64)) {
        self.cells = std::mem::take(&mut self.cells)
            .into_iter()
            .map(|(at, cell)| (place(at), cell))
            .collect();
    }

    fn copy(&mut self, to: impl Fn((i64, i64)) -> Option<(i64, i64)>) {
        let copies: Vec<_> = self
            .cells
            .iter()
            .filter_map(|(at, cell)| Some((to(*at)?, cell.clone())))
            .collect();
        self.cells.extend(copies);
    }

    /// The selection of a click on a cell, in the mode of the table.
    pub(crate) fn selection_at(&self, row: i64, column: i64) -> [i64; 2] {
        let (has_row, has_column) = match self.selection_mode {
            SelectionMode::Item => (true, true),
            SelectionMode::Row => (true, false),
            SelectionMode::Column => (false, true),
        };
        let row_fits = !has_row || (0..self.row_count).contains(&row);
        let column_fits = !has_column || (0..self.column_count).contains(&column);
        if !row_fits || !column_fits {
            return [-1; 2];
        }
        [
            if has_row { row } else { -1 },
            if has_column { column } else { -1 },
        ]
    }
}
