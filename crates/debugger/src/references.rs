//! Numbers by which clients ask for frames and variables. They count until the code goes on.

use script::{Container, FrameId};

/// A frame of a script.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameOf {
    /// The script.
    pub script: i64,
    /// The function that runs in it.
    pub frame: FrameId,
}

/// Something with variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Node {
    /// Variables of a script, seen from a frame if there is one.
    OfScript {
        /// The script.
        script: i64,
        /// What holds the variables.
        container: Container,
        /// Where expressions are evaluated that become their values.
        frame: Option<FrameId>,
    },
    /// The objects of the scene without a parent.
    Objects,
    /// An object: its properties and its children.
    Object(i64),
}

/// What has a number at the moment.
#[derive(Default)]
pub struct References {
    frames: Vec<FrameOf>,
    nodes: Vec<Node>,
}

impl References {
    /// The number of a frame.
    pub fn frame(&mut self, frame: FrameOf) -> usize {
        number(&mut self.frames, frame)
    }

    /// The number of something with variables.
    pub fn node(&mut self, node: Node) -> usize {
        number(&mut self.nodes, node)
    }

    /// The frame with that number.
    ///
    /// # Errors
    /// When there is none.
    pub fn find_frame(&self, number: i64) -> Result<FrameOf, String> {
        find(&self.frames, number).ok_or_else(|| format!("there is no frame {number} any more"))
    }

    /// What has that number.
    ///
    /// # Errors
    /// When there is nothing.
    pub fn find_node(&self, number: i64) -> Result<Node, String> {
        find(&self.nodes, number).ok_or_else(|| format!("there are no variables {number} any more"))
    }

    /// The code goes on.
    pub fn clear(&mut self) {
        self.frames.clear();
        self.nodes.clear();
    }
}

fn number<T: PartialEq>(all: &mut Vec<T>, new: T) -> usize {
    if let Some(known) = all.iter().position(|known| *known == new) {
        return known + 1;
    }
    all.push(new);
    all.len()
}

fn find<T: Copy>(all: &[T], number: i64) -> Option<T> {
    let place = usize::try_from(number).ok()?.checked_sub(1)?;
    all.get(place).copied()
}
