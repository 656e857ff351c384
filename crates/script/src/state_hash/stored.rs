//! Custom data and signals: who has which, and what they are called.

use std::rc::Rc;

use crate::host::Sim;
use scene::{CustomData, Handle, Holder, Namespace, Object, Scene, special};

/// Name of custom data or of a signal, without the mark of its type.
pub(super) type Stored = (Holder, Namespace, String);

/// The number by which scripts know who holds a value.
pub(super) fn target_of(holder: Holder) -> i64 {
    match holder {
        Holder::App => special::APP,
        Holder::Scene => special::SCENE,
        Holder::Object(handle) => handle.raw(),
    }
}

/// The name of a stored value as a property.
pub(super) fn shown(namespace: Namespace, name: &str) -> String {
    match namespace {
        Namespace::CustomData => format!("customData.{name}"),
        Namespace::Signal => format!("signal.{name}"),
    }
}

/// Shows the values of one holder. Custom data of the application outlive the run and are another input of it: they are not shown.
pub(super) fn with_values(
    sim: &Sim,
    scene: &Scene,
    (holder, namespace): (Holder, Namespace),
    look: impl FnOnce(&CustomData),
) {
    let owner = match holder {
        Holder::App if namespace == Namespace::CustomData => return,
        Holder::App => return look(&sim.app.borrow().signals),
        Holder::Scene => None,
        Holder::Object(handle) => Some(handle),
    };
    if let Ok(values) = scene.named_values(owner, namespace) {
        look(values);
    }
}

/// The names of all stored values.
pub(super) fn all_names(sim: &Rc<Sim>, scene: &Scene) -> Vec<Stored> {
    let objects = scene.objects().map(Object::handle).map(Holder::Object);
    let holders = [Holder::App, Holder::Scene].into_iter().chain(objects);
    holders
        .flat_map(|holder| names_of(sim, scene, holder))
        .collect()
}

/// The names of what an object holds.
pub(super) fn names_of_object(sim: &Rc<Sim>, scene: &Scene, object: Handle) -> Vec<Stored> {
    names_of(sim, scene, Holder::Object(object))
}

fn names_of(sim: &Sim, scene: &Scene, holder: Holder) -> Vec<Stored> {
    let mut found = Vec::new();
    for namespace in [Namespace::CustomData, Namespace::Signal] {
        with_values(sim, scene, (holder, namespace), |values| {
            let names = values.names();
            found.extend(names.map(|name| (holder, namespace, name.to_owned())));
        });
    }
    found
}
