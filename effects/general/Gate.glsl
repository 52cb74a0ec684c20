/* In general programs (engine/general.h) effects that a switch of the scene turns off are there all the
 * same: this is the unit of each that says whether it is on. While it is not, its plug functions return
 * before they have done anything. */

uniform bool gate = true;
