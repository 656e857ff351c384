//! Lights, fog and background of a picture.

use rendering::{Background, Fog, FogDensity, Light, LightKind};

use super::{ColourMode, Shot};
use scene::appearance::environment::{Fog as SceneFog, FogType};
use scene::sensor::{Light as SceneLight, LightType};
use scene::{Handle, Kind, Object, Scene};

/// Background of the views of a scene that has none of its own: at the top and at the bottom, as files of the original have it.
const USUAL_BACKGROUND: [[f32; 3]; 2] = [[0.804, 0.867, 0.916], [0.05, 0.05, 0.1]];
/// Where linear fog ends unless the scene says so, metres.
const USUAL_FOG_END: f64 = 5.0;

/// Background behind all objects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Backdrop {
    /// One colour: red, green, blue, 0 to 1.
    Colour([f32; 3]),
    /// The colour of the fog of the scene, for sensors.
    Fog,
    /// The background of the scene's views: from one colour to another.
    Views,
}

impl Backdrop {
    pub(super) fn colours(self, scene: &Scene) -> Background {
        let environment = &scene.settings().environment;
        match self {
            Self::Colour(colour) => Background::plain(colour),
            Self::Fog => Background::plain(environment.fog.colour.unwrap_or_default()),
            Self::Views => {
                let [top, bottom] = views_background(scene);
                Background { bottom, top }
            }
        }
    }
}

/// What views of the scene have behind all objects: the colours at the top and at the bottom.
pub fn views_background(scene: &Scene) -> [[f32; 3]; 2] {
    scene
        .settings()
        .environment
        .background
        .unwrap_or(USUAL_BACKGROUND)
}

/// The lights that are on.
pub(super) fn lights(scene: &Scene, shot: &Shot) -> Vec<Light> {
    if shot.colour_mode == ColourMode::Auxiliary {
        return Vec::new();
    }
    let counts = |object: &&Object| {
        shot.lit_by
            .is_none_or(|above| is_below(scene, object.handle(), above))
    };
    let on = scene.objects().filter_map(|object| match &object.kind {
        Kind::Light(light) if light.enabled && counts(&object) => {
            placed(scene, object.handle(), light)
        }
        _ => None,
    });
    let shining = |light: Light| {
        if shot.has_specular {
            light
        } else {
            Light {
                specular: [0.0; 3],
                ..light
            }
        }
    };
    on.map(shining).collect()
}

fn is_below(scene: &Scene, handle: Handle, above: Handle) -> bool {
    scene.ancestors(handle).any(|ancestor| ancestor == above)
}

fn placed(scene: &Scene, handle: Handle, light: &SceneLight) -> Option<Light> {
    let kind = match light.light_type {
        LightType::Omnidirectional => LightKind::Omni,
        LightType::Spot => LightKind::Spot {
            cutoff: light.spot_cutoff,
            exponent: u32::try_from(light.spot_exponent).unwrap_or(0).min(128),
        },
        LightType::Directional => LightKind::Directional,
    };
    Some(Light {
        diffuse: light.colour.ambient_diffuse,
        specular: light.colour.specular,
        attenuation: light.attenuation.map(|factor| factor as f32),
        casts_shadows: light.casts_shadows,
        ..Light::new(kind, scene.world_pose(handle).ok()?)
    })
}

/// The light that comes from everywhere.
pub(super) fn ambient(scene: &Scene, colour_mode: ColourMode) -> [f32; 3] {
    if colour_mode == ColourMode::Auxiliary {
        return [0.0; 3];
    }
    scene.settings().environment.ambient_light
}

/// The fog of a scene, if it is switched on.
pub(super) fn fog(fog: &SceneFog) -> Option<Fog> {
    let density = match fog.fog_type {
        FogType::EXPONENTIAL => FogDensity::Exponential(fog.density),
        FogType::EXPONENTIAL_SQUARED => FogDensity::ExponentialSquared(fog.density),
        _ => FogDensity::Linear {
            start: fog.start,
            end: fog.end.unwrap_or(USUAL_FOG_END),
        },
    };
    fog.enabled.then(|| Fog {
        density,
        colour: fog.colour.unwrap_or_default(),
    })
}
