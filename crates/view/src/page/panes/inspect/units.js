// Units as people chose to see them: angles in degrees or in radians.
import { remember, setting } from '../../settings.js';

const ANGLE = /^rad(\/s[²³]?)?$/;

export const inDegrees = () => setting('angles', 'degrees') === 'degrees';

export const chooseAngles = (unit) => remember('angles', unit);

/** @param {string | null | undefined} unit of a value @returns {{unit: string, factor: number}} as it is shown */
export function shownUnit(unit) {
  const isAngle = !!unit && unit.split(', ').every((part) => ANGLE.test(part));
  if (!isAngle || !inDegrees()) return { unit: unit ?? '', factor: 1 };
  return { unit: unit.replaceAll('rad', '°'), factor: 180 / Math.PI };
}
