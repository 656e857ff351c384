//! Changes of values, by scripts and by persons: what it becomes, and the events that a change raises.

use super::error::{UiError, UiResult};
use super::widgets::{
    Button, Cell, Checkbox, Combobox, Edit, Label, ProgressBar, Properties, Radiobutton, Slider,
    Spinbox, Table, Tabs, TextBrowser, TextType, Tree, WidgetKind,
};
use super::window::Window;
use scene::Data;

impl Window {
    /// Presses or releases a button that stays down; others stay as they are.
    ///
    /// # Errors
    /// When it is no button.
    pub fn set_button_pressed(&mut self, id: i64, pressed: bool) -> UiResult<()> {
        let button = self.get_mut::<Button>(id)?;
        if !button.checkable {
            return Ok(());
        }
        button.checked = pressed;
        if pressed && button.auto_exclusive {
            self.release_neighbours(id);
        }
        Ok(())
    }

    fn release_neighbours(&mut self, id: i64) {
        let Ok(parent) = self.widget(id).map(|widget| widget.parent) else {
            return;
        };
        let neighbours = self
            .widgets
            .values_mut()
            .filter(|widget| widget.parent == parent && widget.id != id);
        for neighbour in neighbours {
            match &mut neighbour.kind {
                WidgetKind::Button(button) if button.auto_exclusive => button.checked = false,
                WidgetKind::Radiobutton(button) if button.auto_exclusive => button.checked = false,
                _ => {}
            }
        }
    }

    /// Sets a slider, within its limits; with `raise` a change calls its handler.
    ///
    /// # Errors
    /// When it is no slider.
    pub fn set_slider(&mut self, id: i64, value: i64, raise: bool) -> UiResult<()> {
        let slider = self.get_mut::<Slider>(id)?;
        let value = slider.clamped(value);
        let changes = std::mem::replace(&mut slider.value, value) != value;
        self.raise_change(id, changes && raise, Data::Int(value));
        Ok(())
    }

    fn raise_change(&mut self, id: i64, is_raised: bool, value: Data) {
        if is_raised {
            self.raise(id, "on-change", [value]);
        }
    }

    /// Sets the text of an edit; with `raise` a change calls its handler.
    ///
    /// # Errors
    /// When it is no edit.
    pub fn set_edit(&mut self, id: i64, value: String, raise: bool) -> UiResult<()> {
        let edit = self.get_mut::<Edit>(id)?;
        let changes = edit.value != value;
        edit.value.clone_from(&value);
        edit.selected &= !changes;
        self.raise_change(id, changes && raise, Data::text(&value));
        Ok(())
    }

    /// Makes an edit the one with selected text, or none for -1.
    ///
    /// # Errors
    /// When it is no edit.
    pub fn select_edit(&mut self, id: i64) -> UiResult<()> {
        if id == -1 {
            return Ok(());
        }
        self.get::<Edit>(id)?;
        for widget in self.widgets.values_mut() {
            if let WidgetKind::Edit(edit) = &mut widget.kind {
                edit.selected = widget.id == id && !edit.value.is_empty();
            }
        }
        Ok(())
    }

    /// Sets a spin box, within its limits; with `raise` a change calls its handler.
    ///
    /// # Errors
    /// When it is no spin box.
    pub fn set_spinbox(&mut self, id: i64, value: f64, raise: bool) -> UiResult<()> {
        let spinbox = self.get_mut::<Spinbox>(id)?;
        let value = spinbox.clamped(value);
        let changes = std::mem::replace(&mut spinbox.value, value) != value;
        let data = if spinbox.decimals.is_some() {
            Data::Float(value)
        } else {
            Data::Int(value as i64)
        };
        self.raise_change(id, changes && raise, data);
        Ok(())
    }

    /// Sets a check box: 0 unchecked, 1 partially, 2 checked; with `raise` a change calls its handler.
    ///
    /// # Errors
    /// When it is no check box, or the value is none of 0, 1 and 2.
    pub fn set_checkbox(&mut self, id: i64, value: i64, raise: bool) -> UiResult<()> {
        let checkbox = self.get_mut::<Checkbox>(id)?;
        if !(0..=2).contains(&value) {
            return Err(UiError::other("invalid checkbox value: must be 0, 1 or 2"));
        }
        let changes = std::mem::replace(&mut checkbox.value, value) != value;
        self.raise_change(id, changes && raise, Data::Int(value));
        Ok(())
    }

    /// Checks a radio button, which clears the others beside it; one of several that exclude each other cannot be cleared.
    ///
    /// # Errors
    /// When it is no radio button, or the value is none of 0 and 1.
    pub fn set_radiobutton(&mut self, id: i64, value: i64) -> UiResult<()> {
        let button = self.get_mut::<Radiobutton>(id)?;
        match value {
            0 if button.auto_exclusive => {}
            0 => button.checked = false,
            1 => {
                button.checked = true;
                if button.auto_exclusive {
                    self.release_neighbours(id);
                }
            }
            _ => return Err(UiError::other("invalid radiobutton value: must be 0 or 1")),
        }
        Ok(())
    }

    /// Sets the text of a label.
    ///
    /// # Errors
    /// When it is no label.
    pub fn set_label(&mut self, id: i64, text: String) -> UiResult<()> {
        self.get_mut::<Label>(id)?.text = text;
        Ok(())
    }

    /// Changes a combo box and raises an event if another item is selected then.
    ///
    /// # Errors
    /// When it is no combo box.
    pub fn change_combobox(
        &mut self,
        id: i64,
        raise: bool,
        change: impl FnOnce(&mut Combobox),
    ) -> UiResult<()> {
        let combobox = self.get_mut::<Combobox>(id)?;
        let before = combobox.selected;
        change(combobox);
        let selected = combobox.selected;
        let index = selected.map_or(-1, |selected| selected as i64);
        self.raise_change(id, selected != before && raise, Data::Int(index));
        Ok(())
    }

    /// Shows a page of tabs; nothing for one there is not.
    ///
    /// # Errors
    /// When they are no tabs.
    pub fn set_tab(&mut self, id: i64, index: i64) -> UiResult<()> {
        let tabs = self.get_mut::<Tabs>(id)?;
        if let Some(index) = usize::try_from(index)
            .ok()
            .filter(|index| *index < tabs.pages.len())
        {
            tabs.current = index;
        }
        Ok(())
    }

    /// Values outside of the limits are ignored.
    ///
    /// # Errors
    /// When it is no progress bar.
    pub fn set_progress(&mut self, id: i64, value: i64) -> UiResult<()> {
        let bar = self.get_mut::<ProgressBar>(id)?;
        if (bar.minimum..=bar.maximum).contains(&value) {
            bar.value = value;
        }
        Ok(())
    }

    /// Sets the text of a text browser; with `raise` a change calls its handler.
    ///
    /// # Errors
    /// When it is no text browser.
    pub fn set_browser_text(&mut self, id: i64, text: String, raise: bool) -> UiResult<()> {
        let browser = self.get_mut::<TextBrowser>(id)?;
        let changes = browser.text != text;
        browser.text.clone_from(&text);
        browser.url.clear();
        let delivered = match browser.text_type {
            TextType::Html => Data::text(&html_document(&text)),
            _ => Data::text(&text),
        };
        self.raise_change(id, changes && raise, delivered);
        Ok(())
    }

    /// Sets the text of a cell; handlers learn of it as of an activation.
    ///
    /// # Errors
    /// When it is no table.
    pub fn set_cell(
        &mut self,
        id: i64,
        [row, column]: [i64; 2],
        text: String,
        raise: bool,
    ) -> UiResult<()> {
        let table = self.get_mut::<Table>(id)?;
        let changes = table.set_text(row, column, text.clone());
        if changes && raise {
            self.raise_cell(id, [row, column], &text);
        }
        Ok(())
    }

    pub(super) fn raise_cell(&mut self, id: i64, [row, column]: [i64; 2], text: &str) {
        self.raise(
            id,
            "on-cell-activate",
            [Data::Int(row), Data::Int(column), Data::text(text)],
        );
    }

    /// Sets the texts of a table from its first cell on: the rows become as many as there are, columns only more.
    ///
    /// # Errors
    /// When it is no table.
    pub fn set_cells(&mut self, id: i64, rows: Vec<Vec<String>>) -> UiResult<()> {
        let table = self.get_mut::<Table>(id)?;
        let longest = rows.iter().map(Vec::len).max().unwrap_or(0) as i64;
        table.resize(rows.len() as i64, table.column_count.max(longest));
        for (row, texts) in (0..).zip(rows) {
            for (column, text) in (0..).zip(texts) {
                let cell = table
                    .cells
                    .entry((row, column))
                    .or_insert_with(|| Cell::of_text(String::new()));
                cell.text = text;
            }
        }
        Ok(())
    }

    /// Selects a cell, row or column, as the mode of the table says; with `raise` a change calls its handler.
    ///
    /// # Errors
    /// When it is no table.
    pub fn select_cell(&mut self, id: i64, row: i64, column: i64, raise: bool) -> UiResult<()> {
        let table = self.get_mut::<Table>(id)?;
        let selection = table.selection_at(row, column);
        let changes = std::mem::replace(&mut table.selection, selection) != selection;
        if changes && raise {
            self.raise(id, "on-selection-change", selection.map(Data::Int));
        }
        Ok(())
    }

    /// Selects an item of a tree; none for an unknown one.
    ///
    /// # Errors
    /// When it is no tree.
    pub fn select_item(&mut self, id: i64, item: i64, raise: bool) -> UiResult<()> {
        let tree = self.get_mut::<Tree>(id)?;
        let item = if tree.items.contains_key(&item) {
            item
        } else {
            0
        };
        let changes = std::mem::replace(&mut tree.selected, item) != item;
        if changes && raise {
            self.raise(id, "on-selection-change", [Data::Int(item)]);
        }
        Ok(())
    }

    /// Selects a row of properties; none for one there is not.
    ///
    /// # Errors
    /// When they are no properties.
    pub fn select_property(&mut self, id: i64, row: i64, raise: bool) -> UiResult<()> {
        let properties = self.get_mut::<Properties>(id)?;
        let row = if (0..properties.rows.len() as i64).contains(&row) {
            row
        } else {
            -1
        };
        let changes = std::mem::replace(&mut properties.selected, row) != row;
        if changes && raise {
            self.raise(id, "on-selection-change", [Data::Int(row)]);
        }
        Ok(())
    }
}

/// A text as a whole document, as handlers get it.
fn html_document(text: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\" /></head><body>{text}</body></html>"
    )
}
