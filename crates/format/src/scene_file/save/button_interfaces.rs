//! Custom user interfaces of V-REP. A model has those of its objects.

use super::Context;
use crate::ttt::chunks::{Button as ButtonChunk, ButtonBlock};
use scene::tree::button_interfaces::{Button, ButtonInterface};

pub(super) fn blocks(context: &Context<'_>, is_model: bool) -> Vec<ButtonBlock> {
    let interfaces = context.scene.button_interfaces().iter();
    let saved =
        interfaces.filter(|(_, interface)| !is_model || context.file_handle(interface.object) >= 0);
    saved
        .map(|(handle, interface)| block(context, handle, interface))
        .collect()
}

fn block(context: &Context<'_>, handle: i64, interface: &ButtonInterface) -> ButtonBlock {
    ButtonBlock {
        rollup: Some(interface.rollup),
        name: Some(interface.name.as_str().into()),
        attributes: Some(interface.attributes),
        handle: Some(numbers::low_i32(handle)),
        cells: Some(interface.cells),
        position: Some(interface.position),
        button_size: Some(interface.cell_size),
        view: Some(interface.view),
        object: Some(context.file_handle(interface.object)),
        buttons: interface.buttons.iter().map(button).collect(),
        texture: None,
    }
}

fn button(button: &Button) -> ButtonChunk {
    let ([x, y], [length, height]) = (button.cell, button.span);
    let numbers = [button.attributes, button.number, length, height, x, y];
    ButtonChunk {
        look: Some((
            numbers,
            button.label.as_str().into(),
            button.down_label.as_str().into(),
            button.slider,
        )),
        colours: Some(button.colours),
        texture: None,
    }
}
