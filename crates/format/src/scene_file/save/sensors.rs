//! Sensors, cameras, lights, graphs.

use super::{Context, colour};
use crate::ttt::Counted;
use crate::ttt::chunks as file;
use scene::sensor::volume::Volume;
use scene::sensor::volume_faces::VolumeFaces;
use scene::sensor::{Camera, Entity, Light, ProximitySensor, VisionSensor};

/// Kinds of detectable objects in old versions.
const ULTRASONIC: i32 = 16;
/// The bits that later renderers read: all of what a picture can show.
const RENDER_EVERYTHING: i32 = 3969;
/// Every way of moving a camera by hand.
const ALL_MANIPULATIONS: i32 = 31;

type Colour = Option<file::Colour>;

/// A number of bits, each from its switch.
pub(super) fn bits(switches: &[(bool, u8)]) -> u8 {
    switches
        .iter()
        .filter(|(on, _)| *on)
        .fold(0, |bits, (_, bit)| bits | 1 << bit)
}

/// An object, a collection, or everything.
fn entity(context: &Context<'_>, entity: Entity) -> i32 {
    match context.scene.collections().get(entity.raw()) {
        Ok(_) => numbers::low_i32(entity.raw()),
        Err(_) => context.file_handle(entity.object()),
    }
}

pub(super) fn proximity_sensor(
    context: &Context<'_>,
    sensor: &ProximitySensor,
    colour: Colour,
) -> file::ProximitySensor {
    let switches = [
        (sensor.show_volume, 0),
        (sensor.exact, 1),
        (!sensor.front_faces, 4),
        (!sensor.back_faces, 5),
        (sensor.explicit, 7),
    ];
    file::ProximitySensor {
        sensor_type: Some(sensor.volume.volume_type as i32),
        volume: Some(volume(&sensor.volume, sensor.faces())),
        size: Some(sensor.size),
        angle_threshold: Some(sensor.angle_threshold),
        switches: Some(bits(&switches)),
        switches_2: Some(bits(&[(sensor.randomized, 1)])),
        randomized: Some([
            numbers::low_i32(sensor.samples),
            numbers::low_i32(sensor.required_samples),
        ]),
        colour,
        colour3: Some(colour::colour(&sensor.ray_colour)),
        detectable: Some(entity(context, sensor.entity)),
        sensable_type: Some(ULTRASONIC),
        ..file::ProximitySensor::default()
    }
}

fn volume(volume: &Volume, faces: VolumeFaces) -> file::Volume {
    let [x, x_far] = volume.x_size;
    let [y, y_far] = volume.y_size;
    let [radius, radius_far] = volume.radius;
    let [sides, sides_far] = volume.faces.map(numbers::low_i32);
    let [subdivisions, subdivisions_far] = volume.subdivisions.map(numbers::low_i32);
    file::Volume {
        // Sensors and their volumes have different numbers: a ray is 34 and 4.
        volume_type: Some(numbers::low_i32(volume.volume_type.index())),
        sizes: Some([
            volume.offset,
            volume.range,
            x,
            y,
            x_far,
            y_far,
            radius,
            radius_far,
            volume.angle,
        ]),
        inside_angle: Some(volume.inside_gap),
        faces: Some([sides, sides_far, subdivisions, subdivisions_far]),
        smallest_distance: Some(volume.close_threshold),
        switches: Some(0),
        planes_inside: Some(Counted(faces.planes_inside)),
        planes_outside: Some(Counted(faces.planes_outside)),
        normals_inside: Some(Counted(faces.normals_inside)),
        normals_outside: Some(Counted(faces.normals_outside)),
        edges: Some(Counted(faces.edges)),
        non_detect_edges: Some(Counted(faces.close_edges)),
        ..file::Volume::default()
    }
}

pub(super) fn vision_sensor(
    context: &Context<'_>,
    sensor: &VisionSensor,
    colour: Colour,
) -> file::VisionSensor {
    let view = &sensor.view;
    let third = [
        (view.perspective, 0),
        (sensor.explicit, 1),
        (sensor.ignore_fog, 2),
        (view.show_frustum, 4),
        (sensor.local_lights, 6),
        (sensor.background_from_environment, 7),
    ];
    let second = [
        (sensor.external_image, 0),
        (sensor.ignore_image, 1),
        (sensor.ignore_depth, 2),
        (sensor.omit_statistics, 4),
    ];
    file::VisionSensor {
        optics: Some([
            view.ortho_size,
            view.angle,
            view.clipping[0],
            view.clipping[1],
        ]),
        resolution: Some(view.resolution.map(|pixels| pixels.cast_signed())),
        renderable: Some(entity(context, sensor.entity)),
        default_buffer: Some(sensor.background),
        size: Some(sensor.size),
        render_mode: Some(numbers::low_i32(sensor.render_mode.0)),
        render_attributes: Some(RENDER_EVERYTHING),
        switches_3: Some(bits(&third)),
        switches_2: Some(bits(&second)),
        colour,
        ..file::VisionSensor::default()
    }
}

pub(super) fn camera(context: &Context<'_>, camera: &Camera, colour: Colour) -> file::Camera {
    let view = &camera.view;
    file::Camera {
        tracked_and_size: Some((context.file_handle(camera.tracked), camera.size)),
        optics: Some([view.ortho_size, view.angle]),
        clipping: Some(view.clipping),
        manip: Some(ALL_MANIPULATIONS),
        old_render_mode: Some(0),
        render_mode: Some(0),
        cpm: Some(view.perspective.into()),
        switches: Some(bits(&[(view.show_frustum, 7)])),
        switches_2: Some(bits(&[(true, 0), (view.perspective, 1)])),
        colour,
        ..file::Camera::default()
    }
}

pub(super) fn light(light: &Light, colour: Colour) -> file::Light {
    file::Light {
        kind_and_size: Some((
            [
                light.light_type as i32,
                numbers::low_i32(light.spot_exponent),
            ],
            light.size,
        )),
        spot_cutoff: Some(light.spot_cutoff),
        attenuation: Some(light.attenuation),
        switches: Some(bits(&[(light.enabled, 0), (!light.casts_shadows, 2)])),
        colour,
        light_colour: Some(colour::emitted(&light.colour)),
        ..file::Light::default()
    }
}
