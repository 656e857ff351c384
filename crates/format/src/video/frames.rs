//! What changes from picture to picture: a rectangle, for a number of periods.

/// Part of a picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Frame {
    /// From the left and from the top, pixels; both even, as WebP needs them.
    pub place: [u32; 2],
    pub size: [u32; 2],
    /// RGB, rows from the top.
    pub pixels: Vec<u8>,
    /// When it is shown, in periods since the beginning of the video.
    pub begin: u64,
    pub end: u64,
}

impl Frame {
    /// How long it is shown, in units of which `per_second` make a second: the ends are rounded, so that no error adds up.
    pub(super) fn duration(&self, rate: f64, per_second: f64) -> u64 {
        let time =
            |periods: u64| numbers::truncated_u64((periods as f64 * per_second / rate).round());
        time(self.end) - time(self.begin)
    }
}

/// Turns pictures into frames: one that is equal to the one before makes that longer.
pub(super) struct Frames {
    width: u32,
    /// Longest time of a frame, in periods: files have no room for longer ones.
    longest: u64,
    last: Vec<u8>,
    /// Not complete before the next picture is known.
    frame: Option<Frame>,
}

impl Frames {
    /// Frames are shown for `longest` seconds at most.
    pub(super) fn new(width: u32, rate: f64, longest: f64) -> Self {
        Self {
            width,
            longest: numbers::truncated_u64(longest * rate).max(1),
            last: Vec::new(),
            frame: None,
        }
    }

    /// Adds a picture; the frame before it, if that is complete now.
    pub(super) fn add(&mut self, picture: &[u8], periods: u64) -> Option<Frame> {
        if let Some(frame) = &mut self.frame
            && *picture == self.last
            && frame.end + periods - frame.begin <= self.longest
        {
            frame.end += periods;
            return None;
        }
        let begin = self.frame.as_ref().map_or(0, |frame| frame.end);
        let (place, size) = self.changed(picture);
        let pixels = crop(picture, self.width, place, size);
        picture.clone_into(&mut self.last);
        self.frame.replace(Frame {
            place,
            size,
            pixels,
            begin,
            end: begin + periods,
        })
    }

    /// The last frame.
    pub(super) fn finish(&mut self) -> Option<Frame> {
        self.frame.take()
    }

    /// The smallest rectangle around what differs from the last picture, of two pixels at least.
    fn changed(&self, picture: &[u8]) -> ([u32; 2], [u32; 2]) {
        let row = 3 * self.width as usize;
        let height = numbers::count_u32(picture.len() / row);
        if self.last.is_empty() {
            return ([0, 0], [self.width, height]);
        }
        let (mut low, mut high) = ([u32::MAX; 2], [0; 2]);
        for (y, (new, old)) in picture
            .chunks_exact(row)
            .zip(self.last.chunks_exact(row))
            .enumerate()
        {
            let mut differing = new
                .iter()
                .zip(old)
                .enumerate()
                .filter(|(_, (new, old))| new != old)
                .map(|(at, _)| at);
            let Some(first) = differing.next() else {
                continue;
            };
            let last = (first..row)
                .rev()
                .find(|at| new[*at] != old[*at])
                .unwrap_or(first);
            low = [
                low[0].min(numbers::count_u32(first) / 3),
                low[1].min(numbers::count_u32(y)),
            ];
            high = [
                high[0].max(numbers::count_u32(last) / 3),
                numbers::count_u32(y),
            ];
        }
        let place = low.map(|low| if low == u32::MAX { 0 } else { low & !1 });
        (place, [high[0] + 1 - place[0], high[1] + 1 - place[1]])
    }
}

fn crop(picture: &[u8], width: u32, place: [u32; 2], size: [u32; 2]) -> Vec<u8> {
    let (first, length) = (3 * place[0] as usize, 3 * size[0] as usize);
    let rows = picture
        .chunks_exact(3 * width as usize)
        .skip(place[1] as usize)
        .take(size[1] as usize);
    rows.flat_map(|row| &row[first..first + length])
        .copied()
        .collect()
}
