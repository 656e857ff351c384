//! An observer of a simulator that is taken back to earlier moments, and forward again.
//!
//! It keeps nothing that lies in the memory of the simulator, and has no cursor in the journal: both would be taken back behind its back. But the
//! number of changes so far is the same whenever the simulator is at the same moment. So where it is the number of the last time, nothing
//! changed, in whatever direction the simulator went.

use std::collections::{BTreeMap, BTreeSet};

use super::{Concerned, Observer, SHOWN, ScriptError, is_restless};
use scene::{Field, Handle, Kind, Scene, Topics};
use script::log::RecentLine;

/// Changes of most steps: these are looked at each time.
const OF_STEPS: Topics =
    Topics::NONE.with_fields(&[Field::Pose, Field::JointPosition, Field::Sensor]);
/// Changes of meshes and of what is on them.
const OF_MESHES: Topics = Topics::TREE.with_fields(&[
    Field::Geometry,
    Field::Appearance,
    Field::Texture,
    Field::Other,
]);

/// What such an observer has seen: numbers of changes.
#[derive(Debug, Default)]
pub(super) struct Reread {
    rare: Option<u64>,
    meshes: Option<u64>,
    /// Scripts that have another error than the last time.
    failed: BTreeSet<Handle>,
}

impl Observer {
    /// An observer of a simulator that is taken back to earlier moments.
    pub(crate) fn that_rereads() -> Self {
        Self {
            reread: Some(Reread::default()),
            ..Self::default()
        }
    }

    /// The last errors of scripts are those in these lines, and no others.
    pub(crate) fn set_errors<'a>(&mut self, lines: impl Iterator<Item = &'a RecentLine>) {
        let before = std::mem::take(&mut self.script_errors);
        let texts = std::mem::take(&mut self.wrong_texts);
        lines.for_each(|line| drop(self.note_errors(std::slice::from_ref(line))));
        let errors = &self.script_errors;
        let is_same = |script: &i64| before.get(script) == errors.get(script);
        self.wrong_texts = texts
            .into_iter()
            .filter(|(script, _)| is_same(script))
            .collect();
        let differ =
            different(&before, &self.script_errors).chain(different(&self.script_errors, &before));
        if let Some(reread) = &mut self.reread {
            reread.failed.extend(differ);
        }
    }

    /// What may look different than the last time.
    pub(super) fn reread(&mut self, scene: &Scene, concerned: &mut Concerned) {
        let journal = scene.journal();
        let (rare, meshes) = (
            journal.total_of(SHOWN.without(OF_STEPS)),
            journal.total_of(OF_MESHES),
        );
        let Some(reread) = &mut self.reread else {
            return;
        };
        let failed = std::mem::take(&mut reread.failed);
        self.meshes.keeps_nothing = true;
        if reread.meshes.replace(meshes) != Some(meshes) {
            self.meshes.forget();
        }
        if reread.rare.replace(rare) != Some(rare) {
            return self.concern_everything(scene, concerned);
        }
        let often = scene
            .objects()
            .filter(|object| is_restless(&object.kind) || changes_often(&object.kind));
        concerned.objects.extend(often.map(::scene::Object::handle));
        concerned
            .objects
            .extend(failed.into_iter().filter(|handle| scene.exists(*handle)));
    }
}

/// Whether the description of such an object changes with [`OF_STEPS`].
fn changes_often(kind: &Kind) -> bool {
    matches!(
        kind,
        Kind::Joint(_) | Kind::ForceSensor(_) | Kind::VisionSensor(_) | Kind::Camera(_)
    )
}

/// The scripts whose error is another one in `others`.
fn different<'a>(
    errors: &'a BTreeMap<i64, ScriptError>,
    others: &'a BTreeMap<i64, ScriptError>,
) -> impl Iterator<Item = Handle> + 'a {
    let differs = |(script, error): &(&i64, &ScriptError)| others.get(script) != Some(*error);
    errors
        .iter()
        .filter(move |entry| differs(entry))
        .filter_map(|(script, _)| Handle::from_raw(*script))
}
