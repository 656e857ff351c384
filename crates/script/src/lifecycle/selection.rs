//! The argument of `sysCall_selChange`.

use scene::{Data, Scene};

/// The selection, as scripts are notified of it.
pub(crate) fn selection_data(scene: &Scene) -> Data {
    let handles: Vec<i64> = scene.selection().iter().map(|h| h.raw()).collect();
    Data::map([("sel", handles.into())])
}
