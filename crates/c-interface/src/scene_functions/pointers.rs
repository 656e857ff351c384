//! Parameters by their place in C, and lists whose length follows from other parameters.

use scene::{Data, numbers};

use crate::dispatch::Call;
use crate::ffi::{Address, Plain};

/// Longest list that a parameter may announce; a larger count is a mistake.
const MAX_ITEMS: usize = Data::MAX_ITEMS;

impl Call<'_> {
    pub(super) fn integer_at(&self, place: usize) -> i64 {
        self.values.get(place).map_or(0, |value| value.integer)
    }

    pub(super) fn number_at(&self, place: usize) -> f64 {
        self.values.get(place).map_or(0.0, |value| value.number)
    }

    /// How many values a parameter announces.
    ///
    /// # Errors
    /// When it is no such number.
    pub(super) fn count_at(&self, place: usize) -> Result<usize, String> {
        let count = self.integer_at(place);
        let valid = usize::try_from(count)
            .ok()
            .filter(|&count| count <= MAX_ITEMS);
        valid.ok_or_else(|| format!("{count} is no number of values"))
    }

    /// `count` values behind an address; None for NULL.
    ///
    /// # Errors
    /// When they are too many.
    pub(super) fn optional_at<T: Plain>(
        &self,
        place: usize,
        count: usize,
    ) -> Result<Option<Vec<T>>, String> {
        if count > MAX_ITEMS {
            return Err(format!("{count} values are too many"));
        }
        let address = self.values.get(place).map(|value| value.address);
        Ok(address.and_then(|address| address.read(count)))
    }

    /// The same, where NULL is a mistake unless nothing is needed.
    ///
    /// # Errors
    /// When they are too many, or not there.
    pub(super) fn list_at<T: Plain>(&self, place: usize, count: usize) -> Result<Vec<T>, String> {
        match self.optional_at(place, count)? {
            Some(values) => Ok(values),
            None if count == 0 => Ok(Vec::new()),
            None => Err(format!(
                "NULL was passed for the {count} values of parameter {}",
                place + 1
            )),
        }
    }

    /// `count` integers as scripts get them.
    ///
    /// # Errors
    /// As [`list_at`](Self::list_at).
    pub(super) fn integers_at(&self, place: usize, count: usize) -> Result<Data, String> {
        self.list_at(place, count).map(integers)
    }

    /// The same; nil for NULL.
    ///
    /// # Errors
    /// As [`optional_at`](Self::optional_at).
    pub(super) fn optional_integers_at(&self, place: usize, count: usize) -> Result<Data, String> {
        Ok(self.optional_at(place, count)?.map_or(Data::Nil, integers))
    }

    /// `count` numbers in the precision of the interface, as scripts get them; nil for NULL.
    ///
    /// # Errors
    /// As [`optional_at`](Self::optional_at).
    pub(super) fn optional_numbers_at(&self, place: usize, count: usize) -> Result<Data, String> {
        Ok(if self.is_double {
            let numbers: Option<Vec<f64>> = self.optional_at(place, count)?;
            numbers.map_or(Data::Nil, Data::from)
        } else {
            self.optional_at(place, count)?.map_or(Data::Nil, floats)
        })
    }

    /// The same, where NULL is a mistake unless nothing is needed.
    ///
    /// # Errors
    /// As [`list_at`](Self::list_at).
    pub(super) fn numbers_at(&self, place: usize, count: usize) -> Result<Data, String> {
        if self.is_double {
            self.list_at::<f64>(place, count).map(Data::from)
        } else {
            self.list_at(place, count).map(floats)
        }
    }

    /// The same for a list of lists.
    ///
    /// # Errors
    /// As [`lists_at`](Self::lists_at).
    pub(super) fn number_lists_at(
        &self,
        place: usize,
        lengths: &[usize],
    ) -> Result<Vec<Data>, String> {
        Ok(if self.is_double {
            let lists = self.lists_at::<f64>(place, lengths)?;
            lists.into_iter().map(Data::from).collect()
        } else {
            let lists = self.lists_at(place, lengths)?;
            lists.into_iter().map(floats).collect()
        })
    }

    /// The letter of a list of numbers in the precision of the interface.
    pub(super) fn number_letter(&self) -> char {
        if self.is_double { 'D' } else { 'F' }
    }

    /// The texts of a list of addresses.
    ///
    /// # Errors
    /// When one is NULL, and as [`list_at`](Self::list_at).
    pub(super) fn texts_at(&self, place: usize, count: usize) -> Result<Vec<Vec<u8>>, String> {
        let texts = self.list_at::<Address>(place, count)?.into_iter();
        texts
            .map(|text| text.text().ok_or_else(|| "NULL is no text".to_owned()))
            .collect()
    }

    /// `count` lengths of lists.
    ///
    /// # Errors
    /// When one is negative, and as [`list_at`](Self::list_at).
    pub(super) fn lengths_at(&self, place: usize, count: usize) -> Result<Vec<usize>, String> {
        let lengths = self.list_at::<i32>(place, count)?.into_iter();
        lengths
            .map(|length| {
                let valid = usize::try_from(length)
                    .ok()
                    .filter(|&length| length <= MAX_ITEMS);
                valid.ok_or_else(|| format!("{length} is no number of values"))
            })
            .collect()
    }

    /// The lists of a list of addresses.
    ///
    /// # Errors
    /// When one is NULL, and as [`list_at`](Self::list_at).
    pub(super) fn lists_at<T: Plain>(
        &self,
        place: usize,
        lengths: &[usize],
    ) -> Result<Vec<Vec<T>>, String> {
        let lists = self.list_at::<Address>(place, lengths.len())?;
        let lists = lists.into_iter().zip(lengths);
        lists
            .map(|(list, &length)| {
                list.read(length)
                    .ok_or_else(|| "NULL is no list".to_owned())
            })
            .collect()
    }

    /// Writes values behind the address of a parameter, unless it is NULL.
    pub(super) fn write_at<T: Plain>(&self, place: usize, values: &[T]) {
        if let Some(value) = self.values.get(place) {
            value.address.write(values);
        }
    }
}

fn integers(values: Vec<i32>) -> Data {
    values.into_iter().map(i64::from).collect::<Vec<_>>().into()
}

/// Floats as scripts get them.
pub(super) fn floats(values: Vec<f32>) -> Data {
    values.into_iter().map(f64::from).collect::<Vec<_>>().into()
}

/// The numbers of a list in single precision; nothing of all else.
pub(super) fn singles(data: &Data) -> Vec<f32> {
    numbers_of(data).into_iter().map(numbers::single).collect()
}

/// The numbers of a list; nothing of all else.
pub(super) fn numbers_of(data: &Data) -> Vec<f64> {
    let Data::Array(items) = data else {
        return Vec::new();
    };
    items
        .iter()
        .map(|item| item.as_f64().unwrap_or_default())
        .collect()
}

/// The integers of a list; nothing of all else.
pub(super) fn integers_of(data: &Data) -> Vec<i32> {
    let Data::Array(items) = data else {
        return Vec::new();
    };
    let integer = |item| numbers::low_i32(crate::dispatch::integer(item));
    items.iter().map(integer).collect()
}

/// The pixels of an image by its width and height.
pub(super) fn area(sides: [i32; 2]) -> usize {
    let [width, height] = sides.map(|side| usize::try_from(side).unwrap_or_default());
    width.saturating_mul(height)
}
