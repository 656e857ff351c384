//! What only ROS 1 has: the bytes of its messages, the MD5 sums that both sides of a connection compare, and the texts that publishers send.

mod decode;
mod definition;
mod encode;

pub use decode::decode;
pub use definition::{definition, md5, service_md5};
pub use encode::encode;
