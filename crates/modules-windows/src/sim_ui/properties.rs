//! `simUI.*`: the table of a property explorer.

use api_macro::api;

use super::arguments::{Texts, WindowHandle};
use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::Bytes;
use ui::{Properties, Property};

pub(super) const FUNCTIONS: &[ApiFn] = functions![
    set_properties,
    set_properties_rows,
    set_properties_selection,
    set_properties_context_menu,
    get_properties_state,
    set_properties_state,
];

/// The rows that lists of their parts describe.
///
/// # Errors
/// When the lists are not equally long.
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn rows_of(
    names: Texts,
    types: Texts,
    values: Texts,
    flags: &[i64],
    displayed_names: Texts,
    displayed_values: Texts,
    icons: &[i64],
    descriptions: Texts,
) -> Result<Vec<Property>> {
    let texts = [
        &types,
        &values,
        &displayed_names,
        &displayed_values,
        &descriptions,
    ];
    let count = names.0.len();
    if texts.iter().any(|list| list.0.len() != count)
        || flags.len() != count
        || icons.len() != count
    {
        return Err(ApiError::Other(
            "the lists must have the same number of elements".into(),
        ));
    }
    let numbers = flags.iter().zip(icons);
    let shown = displayed_names
        .0
        .into_iter()
        .zip(displayed_values.0)
        .zip(descriptions.0);
    let parts = names
        .0
        .into_iter()
        .zip(types.0)
        .zip(values.0)
        .zip(shown)
        .zip(numbers);
    Ok(parts
        .map(
            |(
                (((name, type_name), value), ((displayed_name, displayed_value), description)),
                (flags, icon),
            )| {
                Property {
                    name,
                    type_name,
                    value,
                    flags: *flags,
                    displayed_name,
                    displayed_value,
                    icon: *icon,
                    description,
                }
            },
        )
        .collect())
}

/// Replaces all rows.
///
/// @param handle the window
/// @param id the properties widget
/// @param pnames names
/// @param ptypes types
/// @param pvalues values
/// @param pflags bits 0 and 1: it cannot be changed; -1: the title of a section; -3: a grey value
/// @param pdisplayk names as they are shown
/// @param pdisplayv values as they are shown
/// @param icons 1 for minus, 2 for plus
/// @param descriptions
/// @param suppressEvents false: a change of the selection is handled as one of a person
#[api("simUI.setProperties")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_properties(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    pnames: Texts,
    ptypes: Texts,
    pvalues: Texts,
    pflags: Vec<i64>,
    pdisplayk: Texts,
    pdisplayv: Texts,
    icons: Vec<i64>,
    descriptions: Texts,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let rows = rows_of(
        pnames,
        ptypes,
        pvalues,
        &pflags,
        pdisplayk,
        pdisplayv,
        &icons,
        descriptions,
    )?;
    cx.change_window(&handle.0, |window| {
        let properties = window.get_mut::<Properties>(id)?;
        properties.rows = rows;
        let selected = properties.selected;
        window.select_property(id, selected, !suppress_events)
    })
}

/// Replaces some rows; others stay as they are.
///
/// @param handle the window
/// @param id the properties widget
/// @param rows their numbers, from 0
/// @param pnames names
/// @param ptypes types
/// @param pvalues values
/// @param pflags as of simUI.setProperties
/// @param pdisplayk names as they are shown
/// @param pdisplayv values as they are shown
/// @param icons 1 for minus, 2 for plus
/// @param descriptions
/// @param suppressEvents without effect
#[api("simUI.setPropertiesRows")]
#[allow(clippy::too_many_arguments, reason = "the reference's signature")]
fn set_properties_rows(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    rows: Vec<i64>,
    pnames: Texts,
    ptypes: Texts,
    pvalues: Texts,
    pflags: Vec<i64>,
    pdisplayk: Texts,
    pdisplayv: Texts,
    icons: Vec<i64>,
    descriptions: Texts,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    let _ = suppress_events;
    let new = rows_of(
        pnames,
        ptypes,
        pvalues,
        &pflags,
        pdisplayk,
        pdisplayv,
        &icons,
        descriptions,
    )?;
    cx.change_window(&handle.0, |window| {
        let properties = window.get_mut::<Properties>(id)?;
        for (row, property) in rows.into_iter().zip(new) {
            if let Some(place) = usize::try_from(row)
                .ok()
                .and_then(|row| properties.rows.get_mut(row))
            {
                *place = property;
            }
        }
        Ok(())
    })
}

/// Selects a row.
///
/// @param handle the window
/// @param id the properties widget
/// @param row from 0; -1 for none
/// @param suppressEvents false: a change is handled as one of a person
#[api("simUI.setPropertiesSelection")]
fn set_properties_selection(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    row: i64,
    #[default(true)] suppress_events: bool,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.select_property(id, row, !suppress_events)
    })
}

/// Sets the menu of the rows.
///
/// @param handle the window
/// @param id the properties widget
/// @param keys what the handler gets; -- for a line between entries, # before a disabled one
/// @param titles what is shown
#[api("simUI.setPropertiesContextMenu")]
fn set_properties_context_menu(
    cx: &mut Cx,
    handle: WindowHandle,
    id: i64,
    keys: Texts,
    titles: Texts,
) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        let menu = keys
            .0
            .into_iter()
            .zip(titles.0)
            .map(|(key, title)| [key, title])
            .collect();
        window.get_mut::<Properties>(id)?.menu = menu;
        Ok(())
    })
}

/// How the table is arranged, for simUI.setPropertiesState.
///
/// @param handle the window
/// @param id the properties widget
/// @return state
#[api("simUI.getPropertiesState")]
fn get_properties_state(cx: &Cx, handle: WindowHandle, id: i64) -> Result<Bytes> {
    cx.read_window(&handle.0, |window| {
        Ok(Bytes(window.get::<Properties>(id)?.state.clone()))
    })
}

/// Arranges the table as it was.
///
/// @param handle the window
/// @param id the properties widget
/// @param state of simUI.getPropertiesState
#[api("simUI.setPropertiesState")]
fn set_properties_state(cx: &mut Cx, handle: WindowHandle, id: i64, state: Bytes) -> Result<()> {
    cx.change_window(&handle.0, |window| {
        window.get_mut::<Properties>(id)?.state = state.0;
        Ok(())
    })
}
