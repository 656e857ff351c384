//! Scene-level data: simulation, physics, environment, the page of the window, collections.

use std::collections::BTreeSet;

use super::{Context, custom_data, shape};
use crate::scene_file::load::UNNAMED_COLLECTION;
use crate::ttt::Counted;
use crate::ttt::chunks::{
    Collection, CollectionElement, Dynamics, Environment, ModuleSettings, Page, Simulation, View,
    Views,
};
use crate::ttt::tree::Contents;
use scene::object::viewers::Viewers;
use scene::{
    Calculations, Collection as Collected, CollectionItem, Kind, Members, Object, Scene, Settings,
};

/// The preset of the physics, and of the step, that means settings of one's own.
const CUSTOM: i32 = 5;
const MICROSECONDS: f64 = 1e6;
/// Pages of the window that show nothing.
const FURTHER_PAGES: usize = 7;

pub(super) fn fill(contents: &mut Contents, scene: &Scene) {
    let settings = scene.settings();
    contents.simulation = Some(simulation(settings));
    contents.dynamics = Some(dynamics(settings));
    contents.environment = Some(environment(scene));
    contents.custom_data = custom_data::chunk(&scene.custom_data);
    contents.views = views(scene);
    contents.module_settings = module_settings(&settings.calculations);
}

/// Only where something is switched off: all is on by default.
fn module_settings(on: &Calculations) -> Option<ModuleSettings> {
    let bit = |on: bool, bit: u8| if on { bit } else { 0 };
    let switches = ModuleSettings {
        va5: Some(bit(on.proximity_sensors, 0x1)),
        va2: Some(bit(on.inverse_kinematics, 0x8)),
        // Bit 0 has no meaning here; new scenes of the original have it.
        va3: Some(0x1 | bit(on.collision, 0x2) | bit(on.distance, 0x4) | bit(!on.paths, 0x10)),
        ..ModuleSettings::default()
    };
    (*on != Calculations::default()).then_some(switches)
}

fn simulation(settings: &Settings) -> Simulation {
    let switches = [
        (settings.real_time, 0x1),
        (settings.pause_at_time, 0x4),
        (settings.pause_at_error, 0x8),
        (!settings.remove_new_objects_at_end, 0x80),
    ];
    Simulation {
        old_dt: Some(numbers::single(settings.time_step)),
        dt_us: Some(numbers::truncated_u64(
            (settings.time_step * MICROSECONDS).round(),
        )),
        dt: Some(settings.time_step),
        passes_per_frame: Some(numbers::low_i32(settings.steps_per_rendering)),
        old_preset: Some(CUSTOM),
        switches: Some(
            switches
                .iter()
                .filter(|(on, _)| *on)
                .fold(0, |bits, (_, bit)| bits | bit),
        ),
        old_rt_coef: Some(numbers::single(settings.real_time_factor)),
        rt_coef: Some(settings.real_time_factor),
        old_pause: Some(numbers::single(settings.time_to_pause)),
        pause_us: Some(numbers::truncated_u64(
            (settings.time_to_pause * MICROSECONDS).round(),
        )),
        pause_time: Some(settings.time_to_pause),
        ..Simulation::default()
    }
}

fn dynamics(settings: &Settings) -> Dynamics {
    let dynamics = &settings.dynamics;
    let mut blocks = shape::blocks(dynamics);
    for block in blocks.iter_mut().flatten() {
        if let Some(step) = block.reals.first_mut() {
            *step = dynamics.step;
        }
    }
    let [bullet, ode, vortex, newton, mujoco] = blocks;
    let [engine, version] = dynamics.engine.numbers().map(numbers::low_i32);
    Dynamics {
        engine: Some((engine, dynamics.gravity.map(f64::from), CUSTOM)),
        engine_version: Some(version),
        step_size: Some(dynamics.step),
        switches: Some(u8::from(dynamics.enabled) | u8::from(dynamics.show_contact_points) << 1),
        bullet,
        ode,
        vortex,
        newton,
        mujoco,
        ..Dynamics::default()
    }
}

fn environment(scene: &Scene) -> Environment {
    let around = &scene.settings().environment;
    let (fog, [largest, relative]) = (&around.fog, around.triangle_sizes);
    Environment {
        active_layers: Some(scene.settings().visibility_layers.bits()),
        old_ambient: Some(around.ambient_light.map(|c| c / 2.0)),
        ambient: Some(around.ambient_light),
        acknowledgment: Some(scene.settings().acknowledgment.as_str().into()),
        max_tri_size: Some(largest),
        min_rel_tri: Some(relative),
        fog_end: fog.end,
        fog: Some((fog.fog_type.0, [fog.start, fog.density])),
        fog_colour: fog.colour,
        bg_up: around.background.map(|[up, _]| up),
        bg_down: around.background.map(|[_, down]| down),
        switches: Some(
            around.display | u8::from(fog.enabled) << 4 | u8::from(scene.settings().locked) << 5,
        ),
        extension_string: Some(around.extension_string.as_str().into()),
        ..Environment::default()
    }
}

/// A page with the first camera, so that there is something to see.
fn views(scene: &Scene) -> Option<Views> {
    let camera = scene
        .objects()
        .find(|object| matches!(object.kind, Kind::Camera(_)))?;
    let view = View {
        linked_object: Some(camera.handle().0.cast_signed()),
        place: Some([-0.5, -0.5, 1.0, 1.0]),
        render_mode: Some(0),
        va2: Some(0x15),
        va3: Some(1),
    };
    let sizes = Some(Counted(vec![0.25, 0.25, 0.05, 0.05]));
    let page = Page {
        page_type: Some(0),
        views: vec![view],
        sizes_pos: sizes,
        ..Page::default()
    };
    Some(Views {
        pages: vec![page],
        empty_pages: vec![0; FURTHER_PAGES],
        active_page: Some(0),
    })
}

/// The collections that saved objects refer to; others live only as long as the scripts that made them.
pub(super) fn collections(context: &Context<'_>) -> Vec<Collection> {
    let mut used = BTreeSet::new();
    for object in context
        .saved
        .iter()
        .filter_map(|handle| context.scene.object(*handle).ok())
    {
        used.extend(entity(object));
        if let Viewers::Collection(collection) = object.viewers {
            used.insert(collection);
        }
        used.extend(
            object
                .references
                .iter()
                .flat_map(|(_, list)| list.iter().copied()),
        );
    }
    let is_whole = |collection: &&(i64, &Collected)| {
        let mut bases = collection.1.items.iter().map(|item| item.members.base());
        !collection.1.name.is_empty()
            && bases.all(|base| base.is_some_and(|base| context.saved.contains(&base)))
    };
    used.extend(
        context
            .scene
            .collections()
            .iter()
            .filter(|entry| is_whole(&entry))
            .map(|(handle, _)| handle),
    );
    used.extend(
        context
            .scene
            .collision_objects()
            .iter()
            .flat_map(|(_, object)| object.entities),
    );
    used.extend(
        context
            .scene
            .distance_objects()
            .iter()
            .flat_map(|(_, object)| object.entities),
    );
    used.into_iter()
        .filter_map(|handle| collection(context, handle))
        .collect()
}

fn entity(object: &Object) -> Option<i64> {
    match &object.kind {
        Kind::ProximitySensor(sensor) => Some(sensor.entity.raw()),
        Kind::VisionSensor(sensor) => Some(sensor.entity.raw()),
        _ => None,
    }
}

fn collection(context: &Context<'_>, handle: i64) -> Option<Collection> {
    let collection = context.scene.collections().get(handle).ok()?;
    let name = match collection.name.as_str() {
        "" => format!("{UNNAMED_COLLECTION}{handle}"),
        name => name.to_owned(),
    };
    Some(Collection {
        name: Some(name.as_str().into()),
        handle: Some(numbers::low_i32(handle)),
        flags: Some(collection.overrides.into()),
        elements: collection
            .items
            .iter()
            .enumerate()
            .map(|(at, item)| element(context, item, at))
            .collect(),
        ..Collection::default()
    })
}

fn element(context: &Context<'_>, item: &CollectionItem, at: usize) -> CollectionElement {
    let kind = match (item.members, item.exclude_base) {
        (Members::Single(_), _) => 0,
        (Members::Tree(_), false) => 1,
        (Members::Tree(_), true) => 2,
        (Members::Chain(_), false) => 3,
        (Members::Chain(_), true) => 4,
        (Members::All, _) => 5,
    };
    CollectionElement {
        handles: Some([
            context.file_handle(item.members.base()),
            numbers::count_i32(at),
        ]),
        kind: Some(kind),
        flags: Some((!item.subtract).into()),
    }
}
