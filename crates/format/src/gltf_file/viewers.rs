//! Cameras and lights of scenes and of files.

use std::f64::consts::FRAC_PI_2;

use mesh_files::gltf::{self, Extent, LightKind};

use scene::sensor::{Camera, Light, LightType, View};

/// Pixels along the larger side of a camera that comes from a file.
const PIXELS: f64 = 256.0;
/// Metres that a camera sees which has no limit in its file.
const FAR: f64 = 1000.0;

pub(super) fn camera(view: &View) -> gltf::Camera {
    // A view must begin in front of the camera, and end behind its beginning.
    let near = view.clipping[0].max(1e-4);
    let [width, height] = view.resolution.map(f64::from);
    let [_, half_height, _] = view.frustum_corner(1.0);
    let extent = match view.perspective {
        true => Extent::Angle(2.0 * libm::atan(half_height)),
        false => Extent::Height(2.0 * half_height),
    };
    gltf::Camera {
        extent,
        aspect_ratio: width / height,
        clipping: [near, view.clipping[1].max(2.0 * near)],
    }
}

pub(super) fn camera_object(camera: &gltf::Camera) -> Camera {
    let aspect = camera.aspect_ratio.clamp(1.0 / PIXELS, PIXELS);
    let resolution = [PIXELS * aspect.min(1.0), PIXELS / aspect.max(1.0)]
        .map(|pixels| numbers::truncated(pixels.round()));
    let mut object = Camera::default();
    object.view.set_resolution(resolution);
    // Ours are those of the larger side.
    match camera.extent {
        Extent::Angle(angle) => {
            let half = libm::tan(angle.min(3.0) / 2.0) * aspect.max(1.0);
            object.view.angle = 2.0 * libm::atan(half);
        }
        Extent::Height(height) => {
            (object.view.perspective, object.view.ortho_size) = (false, height * aspect.max(1.0));
        }
    }
    let [near, far] = camera.clipping;
    object.view.clipping = [near, if far > 1e6 { FAR.max(2.0 * near) } else { far }];
    object
}

pub(super) fn light(light: &Light) -> gltf::Light {
    let kind = match light.light_type {
        LightType::Omnidirectional => LightKind::Point,
        LightType::Directional => LightKind::Directional,
        LightType::Spot => LightKind::Spot(light.spot_cutoff.clamp(1e-3, FRAC_PI_2)),
    };
    gltf::Light {
        kind,
        color: light
            .colour
            .ambient_diffuse
            .map(|x| f64::from(x).clamp(0.0, 1.0)),
        intensity: 1.0,
    }
}

pub(super) fn light_object(light: &gltf::Light) -> Light {
    let mut object = Light::new(match light.kind {
        LightKind::Point => LightType::Omnidirectional,
        LightKind::Directional => LightType::Directional,
        LightKind::Spot(_) => LightType::Spot,
    });
    if let LightKind::Spot(angle) = light.kind {
        object.spot_cutoff = angle.clamp(1e-3, FRAC_PI_2);
    }
    object.colour.ambient_diffuse = light.color.map(numbers::single);
    object
}
