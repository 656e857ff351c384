//! Pictures of vision sensors.

use rendering::{Channels, Picture};

use super::{Backdrop, ColourMode, Shot, Subjects, Vision};
use scene::sensor::{Entity, RenderMode, VisionSensor};
use scene::{Handle, Scene, SceneResult};

/// The colour of nothing where colours are handles.
const NOTHING: [u8; 3] = [255; 3];

/// Picture of a vision sensor. Channels that the sensor ignores are missing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SensorPicture {
    /// Red, green, blue of each pixel, from the lowest row.
    pub image: Option<Vec<u8>>,
    /// Depth of each pixel, 0 near to 1 far.
    pub depth: Option<Vec<f32>>,
    /// The objects that are seen, by handle, where the colours are handles.
    pub seen: Option<Vec<Handle>>,
}

impl Vision {
    /// Picture of a sensor; `entity` replaces its own.
    ///
    /// # Errors
    /// When `sensor` is no vision sensor.
    pub fn sensor_picture(
        &mut self,
        scene: &Scene,
        handle: Handle,
        entity: Option<Entity>,
    ) -> SceneResult<SensorPicture> {
        let sensor = scene.object(handle)?.vision_sensor()?;
        let by_handle = sensor.render_mode == RenderMode::HANDLES;
        let channels = Channels {
            colour: !by_handle && !sensor.ignore_image,
            depth: !sensor.ignore_depth,
            ids: by_handle,
        };
        let picture = self.picture(
            scene,
            &sensor_shot(scene, handle, sensor, entity)?,
            channels,
        );
        Ok(if by_handle {
            of_handles(sensor, picture)
        } else {
            of_colours(channels, picture)
        })
    }
}

/// Content and viewpoint for a sensor; `entity` replaces its own.
pub(super) fn sensor_shot(
    scene: &Scene,
    handle: Handle,
    sensor: &VisionSensor,
    entity: Option<Entity>,
) -> SceneResult<Shot> {
    Ok(Shot {
        viewer: Some(handle),
        pose: scene.world_pose(handle)?,
        view: sensor.view.clone(),
        subjects: Subjects::from(entity.unwrap_or(sensor.entity)),
        colour_mode: match sensor.render_mode {
            RenderMode::AUXILIARY => ColourMode::Auxiliary,
            mode => ColourMode::Lit {
                shadows: mode.has_shadows(),
            },
        },
        backdrop: if sensor.background_from_environment {
            Backdrop::Fog
        } else {
            Backdrop::Colour(sensor.background)
        },
        has_fog: !sensor.ignore_fog,
        has_specular: !sensor.ignore_specular,
        lit_by: sensor.local_lights.then_some(handle),
    })
}

fn of_colours(channels: Channels, picture: Picture) -> SensorPicture {
    SensorPicture {
        image: channels.colour.then_some(picture.colour),
        depth: channels.depth.then_some(picture.depth),
        seen: None,
    }
}

/// The handle of each pixel as a colour: the low byte is red, the next one green.
fn of_handles(sensor: &VisionSensor, picture: Picture) -> SensorPicture {
    let colour = |id: u32| match id {
        Picture::NOTHING => NOTHING,
        _ => [id as u8, (id >> 8) as u8, (id >> 16) as u8],
    };
    let mut seen: Vec<u32> = picture
        .ids
        .iter()
        .copied()
        .filter(|id| *id != Picture::NOTHING)
        .collect();
    seen.sort_unstable();
    seen.dedup();
    SensorPicture {
        image: (!sensor.ignore_image)
            .then(|| picture.ids.iter().flat_map(|id| colour(*id)).collect()),
        depth: (!sensor.ignore_depth).then_some(picture.depth),
        seen: Some(seen.into_iter().map(Handle).collect()),
    }
}
