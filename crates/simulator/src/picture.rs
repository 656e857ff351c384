//! Pictures and videos of the scene for Rust programs.

use super::{Error, Simulator};
use perception::vision::{Channels, Picture, Viewpoint, projection};
use scene::Handle;
use scene::sensor::View;
use script::{ApiError, VideoFailure, VideoOptions};

impl Simulator {
    /// Picture of a camera or a vision sensor; without one the scene from a place where all of it can be seen. `resolution` (width and
    /// height, at most 4096 each) replaces the camera's own. Ids are handles of objects; rows begin at the bottom.
    ///
    /// # Errors
    /// When `from` is neither a camera nor a vision sensor.
    pub fn picture(
        &self,
        from: Option<Handle>,
        resolution: Option<[u32; 2]>,
        channels: Channels,
    ) -> Result<Picture, Error> {
        let picture = self.copied(|sim| {
            let scene = sim.scene.borrow();
            let vision = &mut sim.perception.borrow_mut().vision;
            vision.view(&scene, from, resolution, channels)
        });
        Ok(picture.map_err(ApiError::from)?)
    }

    /// What is seen from a viewpoint, in a picture of that width and height, and the projection with which it is drawn.
    ///
    /// # Errors
    /// When the object of the viewpoint is gone.
    pub fn picture_from(
        &self,
        viewpoint: &Viewpoint,
        resolution: [u32; 2],
        channels: Channels,
    ) -> Result<(Picture, View), Error> {
        let seen = self.copied(|sim| {
            let scene = sim.scene.borrow();
            let shot = viewpoint.shot(&scene, resolution)?;
            let vision = &mut sim.perception.borrow_mut().vision;
            let picture = vision.picture(&scene, &shot, channels);
            Ok((picture, shot.view))
        });
        seen.map_err(|error: scene::SceneError| ApiError::from(error).into())
    }

    /// The projection with which `picture` draws: near and far plane, angle, resolution.
    ///
    /// # Errors
    /// When `from` is neither a camera nor a vision sensor.
    pub fn projection(&self, from: Option<Handle>) -> Result<View, Error> {
        Ok(projection(&self.parts.sim.scene.borrow(), from).map_err(ApiError::from)?)
    }

    /// Takes a video of the simulation from its next step on, also of one that is started later.
    pub fn start_video(&mut self, options: VideoOptions) {
        self.inside().start_video(options.clone());
    }

    /// Why the video ended before [`finish_video`](Self::finish_video).
    pub fn video_failure(&self) -> Option<VideoFailure> {
        self.copied(|sim| sim.video_failure())
    }

    /// Completes the video. Without a step there is no file.
    ///
    /// # Errors
    /// When it could not be written, or the camera is not there. There is a file all the same if there was a picture before.
    pub fn finish_video(&mut self) -> Result<(), VideoFailure> {
        self.copied(|sim| sim.finish_video())
    }
}
