//! Groups of inverse kinematics, which were kept with the scene before 4.2.

use super::HandleMap;
use super::references::numbered;
use crate::ttt::chunks::{IkElement as ElementChunk, IkGroup as GroupChunk};
use crate::ttt::{File, Text};
use scene::tree::ik_groups::{IkElement, IkGroup};
use scene::{Handle, Scene};

/// Set where a group is handled explicitly.
pub(in crate::scene_file) const EXPLICIT: u8 = 0x40;

/// Adds the groups; elements whose tip is gone are left out. Their names are numbered as those of the objects of the file are.
pub(super) fn add(scene: &mut Scene, file: &File, objects: &[Handle], map: &HandleMap) {
    for chunk in &file.contents.ik_groups {
        let group = group(scene, file, objects, map, chunk);
        scene.ik_groups_mut().add(group);
    }
}

fn group(
    scene: &Scene,
    file: &File,
    objects: &[Handle],
    map: &HandleMap,
    chunk: &GroupChunk,
) -> IkGroup {
    let text = |text: &Option<Text>| text.as_ref().map(Text::decode).unwrap_or_default();
    IkGroup {
        name: numbered(scene, file, objects, text(&chunk.name)),
        persistent_uid: text(&chunk.persistent_id),
        explicit: chunk.flags.unwrap_or(0) & EXPLICIT != 0,
        method: chunk.method.unwrap_or(0),
        flags: chunk.flags.unwrap_or(0) & !EXPLICIT,
        performed_after: chunk.do_on.unwrap_or(-1),
        max_iterations: chunk.max_iter.unwrap_or(3),
        damping: chunk
            .damping
            .filter(|damping| damping.is_finite())
            .unwrap_or(0.1),
        elements: chunk
            .elements
            .iter()
            .filter_map(|chunk| element(chunk, map))
            .collect(),
        ..IkGroup::new("")
    }
}

fn element(chunk: &ElementChunk, map: &HandleMap) -> Option<IkElement> {
    let [tip, base] = chunk.tip_and_base?;
    let finite = |numbers: Option<[f64; 2]>| {
        numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()))
    };
    let degrees = |[angle, distance]: [f32; 2]| [f64::from(angle).to_radians(), distance.into()];
    Some(IkElement {
        tip: map.get(&tip).copied()?,
        base: map.get(&base).copied(),
        constraint_base: chunk.alt_base.and_then(|base| map.get(&base).copied()),
        precisions: finite(chunk.precisions.or(chunk.old_precisions.map(degrees)))
            .unwrap_or([0.001; 2]),
        weights: finite(chunk.weights).unwrap_or([1.0; 2]),
        constraints: chunk.constraints.unwrap_or(0),
        flags: chunk.flags.unwrap_or(0),
        enabled: true,
    })
}
