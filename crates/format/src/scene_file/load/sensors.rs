//! Sensors, cameras, lights, and colours (spec: scene-files 7.1, scene-files 7.4).

use super::Context;
use crate::ttt::Counted;
use crate::ttt::chunks as file;
use scene::appearance::colour::Colour;
use scene::sensor::volume::{Volume, VolumeType};
use scene::sensor::volume_faces::VolumeFaces;
use scene::sensor::{
    Camera, Entity, Light, LightType, ProximitySensor, RenderMode, View, VisionSensor,
};

/// Where this bit of a colour is clear, it is translucent.
const OPAQUE: u8 = 0x4;
/// How much brighter colours of sensors and the like were meant before serialization 17.
const BRIGHTER: f32 = 1.5;

/// The colour of a chunk; missing parts are those of `default`.
pub(super) fn colour(chunk: &file::Colour, default: Colour, brighter: bool) -> Colour {
    let mut colour = default;
    if let Some(values) = chunk.values {
        let [ambient, _, specular, emission, auxiliary] = groups(values);
        (colour.ambient_diffuse, colour.specular) = (ambient, specular);
        (colour.emission, colour.auxiliary) = (emission, auxiliary);
    } else if let Some(values) = chunk.old_values {
        let [ambient, diffuse, specular, emission, auxiliary] = groups(values);
        colour.ambient_diffuse = joined(ambient, diffuse);
        (colour.specular, colour.emission, colour.auxiliary) = (specular, emission, auxiliary);
    } else if let Some(values) = chunk.oldest_values {
        let [ambient, diffuse, specular, emission] = groups(values);
        (colour.ambient_diffuse, colour.specular, colour.emission) =
            (joined(ambient, diffuse), specular, emission);
    }
    if brighter {
        let factor = colour
            .ambient_diffuse
            .iter()
            .fold(BRIGHTER, |factor, c| factor.min(1.0 / c.max(1e-6)));
        colour.ambient_diffuse = colour.ambient_diffuse.map(|c| c * factor.max(1.0));
    }
    if chunk.flags.is_some_and(|flags| flags & OPAQUE == 0) {
        colour.opacity = chunk.opacity.unwrap_or(0.5);
    }
    colour
}

pub(super) fn groups<const N: usize, const M: usize>(values: [f32; N]) -> [[f32; 3]; M] {
    std::array::from_fn(|i| [values[3 * i], values[3 * i + 1], values[3 * i + 2]])
}

/// Ambient and diffuse light were separate before 3.1.4.
fn joined(ambient: [f32; 3], diffuse: [f32; 3]) -> [f32; 3] {
    let mean = diffuse.iter().sum::<f32>() / 3.0;
    let sum = ambient.map(|c| (c + mean / 2.0) / 0.85);
    let largest = sum.iter().copied().fold(1.0, f32::max);
    sum.map(|c| c / largest)
}

pub(super) fn proximity_sensor(
    context: &Context<'_>,
    chunk: &file::ProximitySensor,
) -> ProximitySensor {
    let switches = chunk.switches.unwrap_or(0);
    let bit = |bit: u8| switches >> bit & 1 == 1;
    let old_angle = chunk.old_angle_threshold.filter(|_| bit(2));
    let [samples, required] = chunk.randomized.unwrap_or([1, 1]);
    let volume_type = chunk
        .sensor_type
        .map_or(VolumeType::Ray, |number| VolumeType::nearest(number.into()));
    let mut sensor = ProximitySensor {
        volume: volume(volume_type, chunk.volume.as_ref()),
        explicit: bit(7),
        size: chunk.size.unwrap_or(0.01),
        show_volume: bit(0),
        front_faces: !bit(4),
        back_faces: !bit(5),
        exact: bit(1),
        randomized: chunk.switches_2.unwrap_or(0) & 2 != 0,
        samples: samples.into(),
        required_samples: required.into(),
        angle_threshold: chunk.angle_threshold.or(old_angle).unwrap_or(0.0),
        entity: chunk
            .detectable
            .map_or(Entity::ALL, |raw| Entity::from_raw(raw.into())),
        ray_colour: chunk.colour3.as_ref().map_or(Colour::new([1.0; 3]), |c| {
            colour(c, Colour::new([1.0; 3]), context.header.serialization < 17)
        }),
        file_faces: None,
        handled: false,
        detection: None,
    };
    if let Some(faces) = chunk.volume.as_ref().and_then(faces) {
        sensor.set_file_faces(faces);
    }
    sensor
}

/// Faces of the volume, if the file contains them.
fn faces(chunk: &file::Volume) -> Option<VolumeFaces> {
    let list = |list: &Option<Counted<f64>>| {
        list.as_ref()
            .map_or_else(Vec::new, |Counted(list)| list.clone())
    };
    chunk.planes_inside.is_some().then(|| VolumeFaces {
        planes_inside: list(&chunk.planes_inside),
        planes_outside: list(&chunk.planes_outside),
        normals_inside: list(&chunk.normals_inside),
        normals_outside: list(&chunk.normals_outside),
        edges: list(&chunk.edges),
        close_edges: list(&chunk.non_detect_edges),
    })
}

fn volume(volume_type: VolumeType, chunk: Option<&file::Volume>) -> Volume {
    let none = file::Volume::default();
    let chunk = chunk.unwrap_or(&none);
    let [offset, range, x, y, x_far, y_far, radius, radius_far, angle] =
        chunk.sizes.unwrap_or_default();
    let [faces, faces_far, subdivisions, subdivisions_far] =
        chunk.faces.unwrap_or([32, 1, 1, 0]).map(i64::from);
    let old_threshold = chunk
        .old_smallest_distance
        .filter(|_| chunk.switches.unwrap_or(0) & 1 == 1);
    Volume {
        volume_type,
        offset,
        range,
        x_size: [x, x_far],
        y_size: [y, y_far],
        radius: [radius, radius_far],
        angle,
        inside_gap: chunk.inside_angle.unwrap_or(0.0),
        faces: [faces, faces_far],
        subdivisions: [subdivisions, subdivisions_far],
        close_threshold: chunk.smallest_distance.or(old_threshold).unwrap_or(0.0),
    }
}

pub(super) fn vision_sensor(chunk: &file::VisionSensor) -> VisionSensor {
    let [ortho_size, angle, near, far] =
        chunk
            .optics
            .unwrap_or([1.0, 60f64.to_radians(), 0.05, 10.0]);
    let (third, second) = (chunk.switches_3.unwrap_or(0), chunk.switches_2.unwrap_or(0));
    let mut view = View {
        perspective: third & 1 != 0,
        resolution: [1, 1],
        clipping: [near, far],
        angle,
        ortho_size,
        show_frustum: third & 0x10 != 0,
    };
    view.set_resolution(chunk.resolution.unwrap_or([16, 16]).map(i64::from));
    VisionSensor {
        view,
        explicit: third & 2 != 0,
        size: chunk
            .size
            .or(chunk.old_size.map(|[size, ..]| size.into()))
            .unwrap_or(0.01),
        entity: chunk
            .renderable
            .map_or(Entity::ALL, |raw| Entity::from_raw(raw.into())),
        render_mode: match chunk.render_mode {
            // The same with a window of its own.
            Some(6) => RenderMode::EXTERNAL,
            Some(8) => RenderMode::OPENGL3,
            mode => RenderMode(mode.unwrap_or(0).into()),
        },
        background: chunk.default_buffer.unwrap_or_default(),
        background_from_environment: third & 0x80 != 0,
        local_lights: third & 0x40 != 0,
        ignore_fog: third & 0x4 != 0,
        external_image: second & 1 != 0,
        ignore_image: second & 2 != 0,
        ignore_depth: second & 4 != 0,
        ignore_specular: false,
        window: [0; 2],
        omit_statistics: second & 0x10 != 0,
        image: Vec::new(),
        depth: Vec::new(),
        reading: None,
    }
}

pub(super) fn camera(chunk: &file::Camera) -> Camera {
    let mut camera = Camera::default();
    camera.size = chunk.tracked_and_size.map_or(camera.size, |(_, size)| size);
    if let Some([ortho_size, angle]) = chunk.optics {
        (camera.view.ortho_size, camera.view.angle) = (ortho_size, angle);
    }
    camera.view.clipping = chunk.clipping.unwrap_or(camera.view.clipping);
    camera.view.perspective = match (chunk.switches_2, chunk.cpm) {
        (Some(switches), _) => switches & 2 != 0,
        (None, Some(mode)) => mode != 0,
        (None, None) => true,
    };
    camera.view.show_frustum = chunk.switches.unwrap_or(0) & 0x80 != 0;
    camera
}

pub(super) fn light(chunk: &file::Light) -> Light {
    let ([kind, exponent], size) = chunk.kind_and_size.unwrap_or(([1, 5], 0.1));
    let mut light = Light::new(LightType::nearest(kind.into()));
    (light.spot_exponent, light.size) = (exponent.into(), size);
    light.spot_cutoff = chunk.spot_cutoff.unwrap_or(light.spot_cutoff);
    light.attenuation = chunk.attenuation.unwrap_or(light.attenuation);
    let switches = chunk.switches.unwrap_or(1);
    (light.enabled, light.casts_shadows) = (switches & 1 != 0, switches & 4 == 0);
    if let Some(chunk) = &chunk.light_colour {
        light.colour = emitted(chunk, light.colour);
    }
    light
}

/// Emitted light is the second group of a colour; in old files it is the mean of the diffuse light.
fn emitted(chunk: &file::Colour, default: Colour) -> Colour {
    let mut colour = colour(chunk, default, false);
    let second = |values: &[f32]| [values[3], values[4], values[5]];
    if let Some(values) = &chunk.values {
        colour.ambient_diffuse = second(values);
    } else if let Some(values) = chunk
        .old_values
        .as_ref()
        .map(|v| &v[..])
        .or(chunk.oldest_values.as_ref().map(|v| &v[..]))
    {
        colour.ambient_diffuse = [second(values).iter().sum::<f32>() / 3.0; 3];
    }
    colour
}
