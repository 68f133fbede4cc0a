// figures.css as text, for exported files (tools/bundle.mjs).
declare module "*.css?text" {
  const text: string;
  export default text;
}
