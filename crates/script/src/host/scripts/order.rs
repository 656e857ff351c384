//! Execution order of scripts (spec: scripts 6).

use std::rc::Rc;

use crate::host::{Script, Sim};
use scene::object::script_object::{ExecutionPriority, ScriptType};
use scene::{Field, Handle, Mark, ModelFlags, Object, Scene, Topics};

/// Changes that can alter the order of scripts.
const ORDER: Topics =
    Topics::TREE.with_fields(&[Field::ModelProperty, Field::Script, Field::Priority]);

/// Scripts in the order they are called.
pub(crate) type ScriptList = Rc<[Rc<Script>]>;

/// Script lists, kept until the tree changes.
#[derive(Default)]
pub(crate) struct OrderCache {
    known: Option<Mark>,
    simulation: ScriptList,
    customization: ScriptList,
    add_ons: ScriptList,
    sandbox: ScriptList,
    main: ScriptList,
    everyone: ScriptList,
    everyone_stopped: ScriptList,
    everyone_reversed: ScriptList,
}

impl OrderCache {
    pub(crate) fn forget(&mut self) {
        self.known = None;
    }
}

/// A group of scripts that is called together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScriptGroup {
    /// Simulation scripts.
    Simulation,
    /// Customization scripts.
    Customization,
    /// The main script.
    Main,
    /// Add-ons.
    AddOn,
    /// The sandbox.
    Sandbox,
}

impl Sim {
    /// The scripts of a group in regular order.
    pub(crate) fn scripts_in(&self, group: ScriptGroup) -> ScriptList {
        self.refresh_order();
        let cache = self.scripts.order.borrow();
        match group {
            ScriptGroup::Simulation => &cache.simulation,
            ScriptGroup::Customization => &cache.customization,
            ScriptGroup::Main => &cache.main,
            ScriptGroup::AddOn => &cache.add_ons,
            ScriptGroup::Sandbox => &cache.sandbox,
        }
        .clone()
    }

    /// All scripts that are active now, in regular order: while stopped, not simulation scripts and the main script.
    pub(crate) fn active_scripts(&self) -> ScriptList {
        self.refresh_order();
        let cache = self.scripts.order.borrow();
        let stopped = self.clock.is_stopped();
        if stopped {
            &cache.everyone_stopped
        } else {
            &cache.everyone
        }
        .clone()
    }

    /// Reverse order, for contacts: sandbox, add-ons, main, then script objects by increasing depth.
    pub(crate) fn active_scripts_reversed(&self) -> ScriptList {
        self.refresh_order();
        self.scripts.order.borrow().everyone_reversed.clone()
    }

    /// Whether the test holds for all scripts that are called about contacts.
    pub(crate) fn all_active_reversed(&self, test: impl FnMut(&Rc<Script>) -> bool) -> bool {
        self.refresh_order();
        self.scripts
            .order
            .borrow()
            .everyone_reversed
            .iter()
            .all(test)
    }

    fn refresh_order(&self) {
        let mut order = self.scripts.order.borrow_mut();
        if !self
            .scene
            .borrow()
            .journal()
            .changed_since(order.known.get_or_insert_with(|| Mark::new(ORDER)))
        {
            return;
        }
        drop(order);
        let (old, scripts) = (self.attached_by_depth(), self.objects_by_depth());
        let of_type = |scripts: &[Rc<Script>], t: ScriptType| -> ScriptList {
            scripts
                .iter()
                .filter(|s| s.script_type == t)
                .cloned()
                .collect()
        };
        let [old_simulation, simulation] =
            [&old, &scripts].map(|list| of_type(list, ScriptType::Simulation));
        let [old_customization, customization] =
            [&old, &scripts].map(|list| of_type(list, ScriptType::Customization));
        let mut cache = self.scripts.order.borrow_mut();
        cache.simulation = joined(&[&old_simulation, &simulation]);
        cache.customization = joined(&[&old_customization, &customization]);
        cache.add_ons = joined(&[
            &self.scripts.detached_of(ScriptType::AddOn),
            &of_type(&scripts, ScriptType::AddOn),
        ]);
        cache.sandbox = self.scripts.detached_of(ScriptType::Sandbox);
        cache.main = self.scripts.detached_of(ScriptType::Main);
        cache.everyone_stopped = joined(&[&cache.customization, &cache.add_ons, &cache.sandbox]);
        let [objects, others] = [&cache.customization, &cache.simulation].map(reversed);
        cache.everyone_reversed = joined(&[
            &cache.sandbox,
            &cache.add_ons,
            &cache.main,
            &objects,
            &others,
        ]);
        let embedded = joined(&[
            &old_simulation,
            &old_customization,
            &simulation,
            &customization,
        ]);
        cache.everyone = joined(&[&embedded, &cache.main, &cache.add_ons, &cache.sandbox]);
    }

    /// Scripts that are objects, the deepest first.
    fn objects_by_depth(&self) -> Vec<Rc<Script>> {
        let order = by_depth(&self.scene.borrow(), |object| object.script().is_ok());
        order
            .into_iter()
            .filter_map(|handle| self.script(handle.raw()))
            .collect()
    }

    /// Scripts attached to objects, those of the deepest objects first.
    fn attached_by_depth(&self) -> Vec<Rc<Script>> {
        let owners = self.scripts.owners();
        if owners.is_empty() {
            return Vec::new();
        }
        let order = by_depth(&self.scene.borrow(), |object| {
            owners.contains(&object.handle())
        });
        order
            .into_iter()
            .flat_map(|owner| self.scripts.attached_to(owner))
            .collect()
    }

    /// Scripts whose `sysCall_joint` is called for a joint: those attached to it, to its parent, and so on to the root; simulation scripts of the whole chain
    /// first, then customization scripts, the main script, add-ons and the sandbox.
    pub(crate) fn joint_chain(&self, joint: Handle) -> Vec<Rc<Script>> {
        let chain: Vec<Handle> = std::iter::once(joint)
            .chain(self.scene.borrow().ancestors(joint))
            .collect();
        let scripts: Vec<_> = chain
            .into_iter()
            .flat_map(|object| self.scripts_of_object(object))
            .collect();
        let of_type = |t: ScriptType| scripts.iter().filter(move |s| s.script_type == t).cloned();
        let attached = of_type(ScriptType::Simulation).chain(of_type(ScriptType::Customization));
        let detached = [ScriptGroup::Main, ScriptGroup::AddOn, ScriptGroup::Sandbox]
            .map(|group| self.scripts_in(group));
        attached
            .chain(detached.iter().flat_map(|list| list.iter().cloned()))
            .collect()
    }
}

fn joined(lists: &[&ScriptList]) -> ScriptList {
    lists.iter().flat_map(|list| list.iter().cloned()).collect()
}

fn reversed(list: &ScriptList) -> ScriptList {
    list.iter().rev().cloned().collect()
}

/// The objects that match: trees in pre-order with children stably sorted by priority, then the deepest level of the whole scene
/// first.
fn by_depth(scene: &Scene, wanted: impl Fn(&Object) -> bool) -> Vec<Handle> {
    let mut found: Vec<(usize, Handle)> = Vec::new();
    let mut pending: Vec<(usize, Handle)> = sorted(scene, scene.roots())
        .into_iter()
        .rev()
        .map(|h| (0, h))
        .collect();
    while let Some((depth, handle)) = pending.pop() {
        let Ok(object) = scene.object(handle) else {
            continue;
        };
        if object.is_model() && object.model_property.contains(ModelFlags::SCRIPTS_INACTIVE) {
            continue;
        }
        if wanted(object) {
            found.push((depth, handle));
        }
        pending.extend(
            sorted(scene, object.children())
                .into_iter()
                .rev()
                .map(|h| (depth + 1, h)),
        );
    }
    found.sort_by_key(|&(depth, _)| std::cmp::Reverse(depth));
    found.into_iter().map(|(_, handle)| handle).collect()
}

fn sorted(scene: &Scene, siblings: &[Handle]) -> Vec<Handle> {
    let mut list = siblings.to_vec();
    list.sort_by_key(|&h| {
        scene
            .object(h)
            .map_or(ExecutionPriority::Normal, |object| object.priority)
    });
    list
}
