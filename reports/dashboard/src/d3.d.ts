// d3 comes with Plot, without types.
declare module "d3";
