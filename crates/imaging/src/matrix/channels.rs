//! Channels taken apart, put together and exchanged.

use super::{Matrix, MatrixError, MatrixResult, Value, Values, with_values};

impl Matrix {
    /// One image for each channel.
    pub fn split(&self) -> Vec<Self> {
        (0..self.channels)
            .map(|channel| self.channel(channel))
            .collect()
    }

    fn channel(&self, channel: usize) -> Self {
        let values = with_values!(self, values => values.iter().skip(channel).step_by(self.channels).copied().collect());
        Self {
            channels: 1,
            values,
            ..self.shape()
        }
    }

    /// The channels of several images as those of one.
    pub fn merge(images: &[Self]) -> MatrixResult<Self> {
        let first = images.first().ok_or(MatrixError::Mismatch)?;
        let is_alike = |image: &Self| {
            image.size() == first.size() && image.format().depth == first.format().depth
        };
        if !images.iter().all(is_alike) {
            return Err(MatrixError::Mismatch);
        }
        let channels: usize = images.iter().map(|image| image.channels).sum();
        super::value_count(first.size(), channels)?;
        let parts = |pixel: usize| {
            images
                .iter()
                .map(move |image| (image, pixel * image.channels))
        };
        let pixels = 0..first.width * first.height;
        let values = match &first.values {
            Values::Bytes(_) => Values::Bytes(
                pixels
                    .flat_map(|at| parts(at).flat_map(bytes_of))
                    .copied()
                    .collect(),
            ),
            Values::Floats(_) => Values::Floats(
                pixels
                    .flat_map(|at| parts(at).flat_map(floats_of))
                    .copied()
                    .collect(),
            ),
        };
        Ok(Self {
            channels,
            values,
            ..first.shape()
        })
    }

    /// Copies channels of some images to channels of others. Channels are counted over all images of a list; pairs are source and
    /// target, and a negative source clears.
    pub fn mix_channels(
        inputs: &[Self],
        outputs: &mut [Self],
        pairs: &[[i64; 2]],
    ) -> MatrixResult<()> {
        let first = inputs.first().ok_or(MatrixError::Mismatch)?;
        let depth = first.format().depth;
        let is_alike = |image: &Self| image.size() == first.size() && image.format().depth == depth;
        if !inputs.iter().chain(&*outputs).all(is_alike) {
            return Err(MatrixError::Mismatch);
        }
        for &[from, to] in pairs {
            let source = match from {
                ..0 => None,
                _ => Some(locate(inputs.iter().map(|image| image.channels), from)?),
            };
            let (output, channel) = locate(outputs.iter().map(|image| image.channels), to)?;
            let source = source.map(|(image, channel)| inputs[image].channel(channel));
            outputs[output].set_channel(channel, source.as_ref());
        }
        Ok(())
    }

    fn set_channel(&mut self, channel: usize, source: Option<&Self>) {
        fn put<T: Value>(values: &mut [T], first: usize, step: usize, source: Option<&[T]>) {
            for (at, value) in values.iter_mut().skip(first).step_by(step).enumerate() {
                *value = source.map_or(T::default(), |source| source[at]);
            }
        }
        let step = self.channels;
        match (&mut self.values, source.map(|image| &image.values)) {
            (Values::Bytes(values), Some(Values::Bytes(source))) => {
                put(values, channel, step, Some(source));
            }
            (Values::Floats(values), Some(Values::Floats(source))) => {
                put(values, channel, step, Some(source));
            }
            (Values::Bytes(values), _) => put(values, channel, step, None),
            (Values::Floats(values), _) => put(values, channel, step, None),
        }
    }
}

fn bytes_of((image, first): (&Matrix, usize)) -> &[u8] {
    match &image.values {
        Values::Bytes(values) => &values[first..first + image.channels],
        Values::Floats(_) => &[],
    }
}

fn floats_of((image, first): (&Matrix, usize)) -> &[f32] {
    match &image.values {
        Values::Floats(values) => &values[first..first + image.channels],
        Values::Bytes(_) => &[],
    }
}

/// Image and channel of a number that counts the channels of all images.
fn locate(counts: impl Iterator<Item = usize>, number: i64) -> MatrixResult<(usize, usize)> {
    let mut rest = usize::try_from(number).map_err(|_| MatrixError::Range("a channel"))?;
    for (image, count) in counts.enumerate() {
        if rest < count {
            return Ok((image, rest));
        }
        rest -= count;
    }
    Err(MatrixError::Range("a channel"))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{bytes, floats};
    use super::*;

    #[test]
    fn apart_and_together() {
        let image = bytes([2, 1], 3, &[1, 2, 3, 4, 5, 6]);
        let parts = image.split();
        assert_eq!(parts[1], bytes([2, 1], 1, &[2, 5]));
        assert_eq!(Matrix::merge(&parts).unwrap(), image);
        assert_eq!(
            Matrix::merge(&[parts[0].clone(), image.clone()])
                .unwrap()
                .channels,
            4
        );
        assert!(Matrix::merge(&[image, floats([2, 1], 1, &[0.0; 2])]).is_err());
        assert!(Matrix::merge(&[]).is_err());
    }

    #[test]
    fn channels_are_mixed() {
        let image = bytes([1, 1], 3, &[1, 2, 3]);
        let mut outputs = [bytes([1, 1], 1, &[0]), bytes([1, 1], 2, &[9, 9])];
        Matrix::mix_channels(
            std::slice::from_ref(&image),
            &mut outputs,
            &[[2, 0], [0, 2], [-1, 1]],
        )
        .unwrap();
        assert_eq!(outputs, [bytes([1, 1], 1, &[3]), bytes([1, 1], 2, &[0, 1])]);
        assert!(
            Matrix::mix_channels(std::slice::from_ref(&image), &mut outputs, &[[3, 0]]).is_err()
        );
        assert!(Matrix::mix_channels(&[image], &mut outputs, &[[0, i64::MIN]]).is_err());
    }
}
