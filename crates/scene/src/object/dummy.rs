//! Dummies: frames, and the ends of loop closures.

use crate::path_object::PathFollowing;
use crate::{Field, Handle, InertValues, Scene, SceneResult};

/// Type of the link between two dummies (`sim.dummytype_*`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkType {
    /// The two dummies are kept together, which closes a kinematic loop.
    LoopClosure = 0,
    /// The two dummies are the ends of a tendon.
    Tendon = 7,
    /// A link without an effect on the physics.
    Default = 8,
    /// The dummies find each other when models are assembled.
    Assembly = 9,
}

/// A dummy: a frame without a body.
#[derive(Debug, Clone, PartialEq)]
pub struct Dummy {
    /// Diameter, for display.
    pub size: f64,
    /// The partner; a link is always mutual.
    pub link: Option<Handle>,
    /// What the link means.
    pub link_type: LinkType,
    /// Which dummies of other models this one takes when models are assembled; `*` for any.
    pub assembly_tag: String,
    /// On a path of V-REP.
    pub path_following: PathFollowing,
    /// Parameters of physics engines, as they were set.
    pub engine_values: InertValues,
}

impl Dummy {
    /// A dummy without a partner; `size` is its displayed diameter, metres.
    pub fn new(size: f64) -> Self {
        let assembly_tag = "*".to_owned();
        let path_following = PathFollowing::default();
        let engine_values = InertValues::default();
        Self {
            size,
            link: None,
            link_type: LinkType::Default,
            assembly_tag,
            path_following,
            engine_values,
        }
    }
}

impl LinkType {
    /// The type with a script's number, if there is one.
    pub fn from_code(code: i64) -> Option<Self> {
        [
            Self::LoopClosure,
            Self::Tendon,
            Self::Default,
            Self::Assembly,
        ]
        .into_iter()
        .find(|t| *t as i64 == code)
    }

    fn is_dynamic(self) -> bool {
        matches!(self, Self::LoopClosure | Self::Tendon)
    }
}

impl Scene {
    /// Links a dummy with `partner` (None: nobody), who takes its type when that is one of the dynamic ones. Former partners of both
    /// are released. A dummy cannot be its own partner: nothing happens then.
    pub fn link_dummies(&mut self, handle: Handle, partner: Option<Handle>) -> SceneResult<()> {
        let link_type = self.object(handle)?.dummy()?.link_type;
        if let Some(partner) = partner {
            self.object(partner)?.dummy()?;
        }
        if partner == Some(handle) {
            return Ok(());
        }
        self.release_link(handle)?;
        let Some(partner) = partner else {
            return Ok(());
        };
        self.release_link(partner)?;
        self.modify_dummy(handle, |dummy| dummy.link = Some(partner))?;
        self.modify_dummy(partner, |dummy| {
            dummy.link = Some(handle);
            if link_type.is_dynamic() {
                dummy.link_type = link_type;
            }
        })
    }

    fn release_link(&mut self, handle: Handle) -> SceneResult<()> {
        let Some(partner) = self.object(handle)?.dummy()?.link else {
            return Ok(());
        };
        self.modify_dummy(handle, |dummy| dummy.link = None)?;
        self.modify_dummy(partner, |dummy| dummy.link = None)
    }

    /// Changes what the link of a dummy means; a partner follows.
    pub fn set_link_type(&mut self, handle: Handle, link_type: LinkType) -> SceneResult<()> {
        let partner = self.object(handle)?.dummy()?.link;
        for dummy in std::iter::once(handle).chain(partner) {
            self.modify_dummy(dummy, |dummy| dummy.link_type = link_type)?;
        }
        Ok(())
    }

    fn modify_dummy<R>(
        &mut self,
        handle: Handle,
        change: impl FnOnce(&mut Dummy) -> R,
    ) -> SceneResult<R> {
        self.try_modify(handle, Field::Dynamics, |object| {
            object.dummy_mut().map(change)
        })
    }
}
