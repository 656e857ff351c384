//! Custom user interfaces of V-REP.

use super::HandleMap;
use super::references::numbered;
use crate::ttt::chunks::{Button as ButtonChunk, ButtonBlock};
use crate::ttt::{File, Text};
use scene::tree::button_interfaces::{Button, ButtonInterface};
use scene::{Handle, Scene};

/// Adds those of the file. Their names are numbered as those of the objects of the file are.
pub(super) fn add(scene: &mut Scene, file: &File, objects: &[Handle], map: &HandleMap) {
    for chunk in &file.contents.button_blocks {
        let name = numbered(scene, file, objects, text(chunk.name.as_ref()));
        scene
            .button_interfaces_mut()
            .add(interface(chunk, name, map));
    }
}

fn text(text: Option<&Text>) -> String {
    text.map(Text::decode).unwrap_or_default()
}

fn interface(chunk: &ButtonBlock, name: String, map: &HandleMap) -> ButtonInterface {
    ButtonInterface {
        name,
        attributes: chunk.attributes.unwrap_or(0),
        cells: chunk.cells.unwrap_or_default(),
        position: chunk.position.unwrap_or_default(),
        cell_size: chunk.button_size.unwrap_or_default(),
        view: chunk.view.unwrap_or(0),
        object: chunk.object.and_then(|object| map.get(&object).copied()),
        rollup: chunk.rollup.unwrap_or_default(),
        buttons: chunk.buttons.iter().filter_map(button).collect(),
    }
}

/// None where the file does not say what it is.
fn button(chunk: &ButtonChunk) -> Option<Button> {
    let ([attributes, number, length, height, x, y], label, down_label, slider) =
        chunk.look.as_ref()?;
    Some(Button {
        number: *number,
        attributes: *attributes,
        cell: [*x, *y],
        span: [*length, *height],
        label: label.decode(),
        down_label: down_label.decode(),
        slider: if slider.is_finite() {
            slider.clamp(-1.0, 1.0)
        } else {
            0.0
        },
        colours: chunk.colours.unwrap_or_default(),
    })
}
