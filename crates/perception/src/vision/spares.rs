//! Memory of pictures that were replaced, for pictures to come: fresh memory costs more than a small picture.

use rendering::{Channels, Picture};

/// Lists of each kind that are kept.
const MAX_SPARES: usize = 4;

/// Lists that nobody needs any more.
#[derive(Default)]
pub(super) struct Spares {
    colours: Vec<Vec<u8>>,
    depths: Vec<Vec<f32>>,
    ids: Vec<Vec<u32>>,
}

impl Spares {
    /// Keeps lists of colours and depths.
    pub fn keep(&mut self, colours: Vec<u8>, depths: Vec<f32>) {
        keep(&mut self.colours, colours);
        keep(&mut self.depths, depths);
    }

    /// Keeps a list of ids.
    pub fn keep_ids(&mut self, ids: Vec<u32>) {
        keep(&mut self.ids, ids);
    }

    /// Room for the colours of so many pixels. What is in it has no meaning.
    pub fn colours(&mut self, pixels: usize) -> Vec<u8> {
        let mut colours = take(&mut self.colours, 3 * pixels);
        colours.resize(3 * pixels, 0);
        colours
    }

    /// A picture with memory for channels of that resolution, where there is some. What is in it has no meaning.
    pub fn picture(&mut self, [width, height]: [u32; 2], channels: Channels) -> Picture {
        let pixels = width as usize * height as usize;
        let size = |wanted: bool| if wanted { pixels } else { 0 };
        Picture {
            colour: take(&mut self.colours, 3 * size(channels.colour)),
            depth: take(&mut self.depths, size(channels.depth)),
            ids: take(&mut self.ids, size(channels.ids)),
            resolution: [width, height],
        }
    }
}

fn keep<T>(spares: &mut Vec<Vec<T>>, list: Vec<T>) {
    if list.is_empty() {
        return;
    }
    if spares.len() == MAX_SPARES {
        // The oldest.
        spares.remove(0);
    }
    spares.push(list);
}

/// A list of that length; an empty one where none is kept.
fn take<T>(spares: &mut Vec<Vec<T>>, length: usize) -> Vec<T> {
    let fitting = spares.iter().position(|list| list.len() == length);
    fitting.map(|at| spares.remove(at)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_used_again_for_pictures_of_their_size() {
        let mut spares = Spares::default();
        let lists = (vec![7; 12], vec![0.5; 4]);
        let places = (lists.0.as_ptr(), lists.1.as_ptr());
        spares.keep(lists.0, lists.1);
        let other = spares.picture([3, 1], Channels::ALL);
        assert!(other.colour.is_empty() && other.depth.is_empty());
        let same = spares.picture([1, 4], Channels::ALL);
        assert_eq!((same.colour.as_ptr(), same.depth.as_ptr()), places);
        assert!(spares.picture([1, 4], Channels::ALL).colour.is_empty());
    }

    #[test]
    fn few_are_kept() {
        let mut spares = Spares::default();
        (1..20).for_each(|length| spares.keep(vec![0; 3 * length], Vec::new()));
        assert_eq!(spares.colours.len(), MAX_SPARES);
        assert_eq!(spares.picture([19, 1], Channels::COLOUR).colour.len(), 57);
    }

    #[test]
    fn colours_alone_use_memory_again() {
        let mut spares = Spares::default();
        let list = vec![7; 12];
        let place = list.as_ptr();
        spares.keep(list, Vec::new());
        let colours = spares.colours(4);
        assert_eq!((colours.as_ptr(), colours.len()), (place, 12));
        assert_eq!(spares.colours(5).len(), 15);
    }

    #[test]
    fn ids_use_memory_again() {
        let mut spares = Spares::default();
        let list = vec![7; 6];
        let place = list.as_ptr();
        spares.keep_ids(list);
        let picture = spares.picture([2, 3], Channels::IDS);
        assert_eq!((picture.ids.as_ptr(), picture.ids.len()), (place, 6));
    }
}
