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
            self.of_handles(sensor, picture)
        } else {
            of_colours(channels, picture)
        })
    }

    fn of_handles(&mut self, sensor: &VisionSensor, picture: Picture) -> SensorPicture {
        let image = (!sensor.ignore_image).then(|| {
            let mut image = self.spares.colours(picture.ids.len());
            paint_handles(&picture.ids, &mut image);
            image
        });
        let seen = Some(seen(&picture.ids));
        self.spares.keep_ids(picture.ids);
        SensorPicture {
            image,
            depth: (!sensor.ignore_depth).then_some(picture.depth),
            seen,
        }
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
fn paint_handles(ids: &[u32], image: &mut [u8]) {
    for (id, pixel) in ids.iter().zip(image.as_chunks_mut().0) {
        let [r, g, b, _] = id.to_le_bytes();
        *pixel = if *id == Picture::NOTHING {
            NOTHING
        } else {
            [r, g, b]
        };
    }
}

/// The objects that are seen, each once, in the order of their handles.
fn seen(ids: &[u32]) -> Vec<Handle> {
    let mut seen: Vec<u32> = ids.chunk_by(|a, b| a == b).map(|run| run[0]).collect();
    seen.sort_unstable();
    seen.dedup();
    let objects = seen.into_iter().filter(|id| *id != Picture::NOTHING);
    objects.map(Handle).collect()
}
